"""What editors need of theories and stories: colours, errors, and what names mean.

`tokens` says what each piece of a theory is, `story_tokens` of a story, with the
notation's own patterns; `lexers` tells it Pygments, `textmate` editors that read
TextMate's grammars. `findings` are the errors of a file with their places, as `ttr
check` prints them; `outline` has what a theory declares, and where. `server` is the
language server, which has files checked by a `worker`, so that it never waits. May
import: dialogues, theories and all below them.
"""
