"""Work, input and output kept within bounds: nothing here knows any type theory.

`budgets` bound the work of a question, `limits` the size of an input; `inputs` is the
one reader of files and pipes, `files` writes in full or not at all, `python_files` runs
a user's own Python with the `consent` that is given; `unforeseen_errors` is the last
line of defence of a command. May import: errors and escapes.
"""
