"""Reports of studies: pages with tables, figures, theories and dialogues."""

from kille.lab.reports.folders import Report, compare, compared, report

__all__ = ["Report", "compare", "compared", "report"]
