r"""Emacs' modes for theories and stories: colours, comments, and the server's names.

Like Vim's syntax it is made of the words that the parser knows, and tells the kinds of
names only by how they are written. Texts and comments are left to Emacs' own tables.
"""

from __future__ import annotations

from collections.abc import Iterable

from ttr.dialogues.stories.story_reader import MARKS
from ttr.editing.tokens import BEFORE_BRACKETS
from ttr.escapes import json_text
from ttr.notation.parser import BEFORE_NAMES
from ttr.notation.syntax_errors import KEYWORDS
from ttr.types.reserved_words import LOGICAL

_TAIL = (
    r"in\|if\|only\s-+if\|only\|up\s-+to\s-+relabelling\|of\|where\|acts\s-+on\|hears"
)
"""The words that follow a term or a name."""

_BLANKS = " \t\n"

_NO_LABEL = rf"\(?:\s-*[^]:=,.({_BLANKS}]\|\s-*$\)"
"""What stands behind a word that is no label and no name."""


def emacs_mode() -> str:
    """The text of `ttr-mode.el`.

    >>> print(emacs_mode().splitlines()[0][:40])
    ;;; ttr-mode.el --- Theories and stories
    """
    first = [word for word in KEYWORDS if word not in BEFORE_NAMES]
    functions = BEFORE_BRACKETS - {"fun"}
    keywords = [
        (rf"^\s-*\({_any_of(first)}\)\>\s-+[^]:=,.)}}{_BLANKS}]", "keyword"),
        (rf"^\s-*\({_any_of(BEFORE_NAMES)}\)\>\s-+\w", "keyword"),
        (r"^\s-*check\s-+\(not\|unknown\|error\)\>", "keyword"),
        (
            rf"\(?:[]A-Za-z0-9_)}}\"'>,]\s-+\|^\s-+\)\({_TAIL}\)\>{_NO_LABEL}",
            "keyword",
        ),
        (r"\<\(fun\)\s-+\w+\s-*:", "keyword"),
        (rf"\<\({_any_of(functions)}\)(", "builtin"),
        (r"\<\([A-Za-z_]\w*\)(", "function-name"),
        (rf"\<\({_any_of(LOGICAL)}\)\>", "type"),
        (rf"\<\([A-Z]\w*\)\>\(?:\s-*[^:={_BLANKS}]\|\s-*$\)", "type"),
        (r"\<\([A-Z]\w*\)\s-*:=", "variable-name"),
        (r"\<\([0-9]+\(?:\.[0-9]+\)?\(?:[eE][+-]?[0-9]+\)?\)\>", "constant"),
    ]
    marks = _any_of(_escape(it) for it in MARKS)
    return _FILE.format(
        keywords=_keywords(keywords),
        story=_keywords([(rf"^\s-*\({marks}\)", "keyword")]),
    )


def _keywords(patterns: Iterable[tuple[str, str]]) -> str:
    """Patterns and faces as font-lock takes them."""
    return "\n    ".join(
        f"({json_text(it)} 1 font-lock-{face}-face)" for it, face in patterns
    )


def _escape(word: str) -> str:
    return "".join(rf"\{it}" if it in ".*+?[^$\\" else it for it in word)


def _any_of(words: Iterable[str]) -> str:
    return r"\|".join(sorted(words, reverse=True))


_FILE = """\
;;; ttr-mode.el --- Theories and stories of TTR  -*- lexical-binding: t -*-

;; Written by: ttr editor emacs FILE

;;; Commentary:

;; Colours of theories (.ttr) and stories (.dlg).  Where Eglot is installed, `M-x eglot'
;; starts the language server, `ttr lsp'.

;;; Code:

(defvar ttr-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?# "<" table)
    (modify-syntax-entry ?\\n ">" table)
    (modify-syntax-entry ?\\" "\\"" table)
    (modify-syntax-entry ?\\' "\\"" table)
    (modify-syntax-entry ?_ "w" table)
    (dolist (sign '(?& ?* ?+ ?- ?/ ?< ?= ?> ?| ?~ ?@ ?^ ?. ?:))
      (modify-syntax-entry sign "." table))
    table)
  "What letters are in theories.")

(defconst ttr-mode-keywords
  '({keywords})
  "What is coloured in theories, besides texts and comments.")

(defconst ttr-mode-propertize
  (syntax-propertize-rules
   ("\\\\\\\\" (0 (unless (nth 3 (syntax-ppss (match-beginning 0)))
                (string-to-syntax ".")))))
  "Outside of texts a backslash is the λ of a function, or a part of ∧ and ∨.")

;;;###autoload
(define-derived-mode ttr-mode prog-mode "TTR"
  "Theories of Type Theory with Records."
  (setq-local comment-start "# ")
  (setq-local comment-start-skip "#+\\\\s-*")
  (setq-local syntax-propertize-function ttr-mode-propertize)
  (setq-local font-lock-defaults '(ttr-mode-keywords nil nil)))

(defconst ttr-story-mode-keywords
  '({story})
  "What is coloured in stories, besides comments.")

(defvar ttr-story-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?\\" "." table)
    table)
  "What letters are in stories.")

;;;###autoload
(define-derived-mode ttr-story-mode prog-mode "TTR story"
  "Stories, that is, dialogues that are played with a game."
  (setq-local comment-start "# ")
  (setq-local comment-start-skip "#+\\\\s-*")
  (setq-local font-lock-defaults
              (list (append '(("\\\\(?:^\\\\|\\\\s-\\\\)\\\\(#.*\\\\)$" 1
                               font-lock-comment-face))
                            ttr-story-mode-keywords)
                    t nil)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\\\.ttr\\\\'" . ttr-mode))
;;;###autoload
(add-to-list 'auto-mode-alist '("\\\\.dlg\\\\'" . ttr-story-mode))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs
               '((ttr-mode ttr-story-mode) . ("ttr" "lsp"))))

(provide 'ttr-mode)

;;; ttr-mode.el ends here
"""
