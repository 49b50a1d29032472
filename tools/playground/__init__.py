"""The playground: a page that runs `ttr` in the browser, without an install.

`building` makes the page, `answers` is what it asks of `ttr` there, `links` makes
theories into links, `serving` shows a folder on this machine.
"""
