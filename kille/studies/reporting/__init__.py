"""Reports of studies: pages with tables, figures, theories and dialogues."""

from kille.studies.reporting.folders import Report, compare, compared, report

__all__ = ["Report", "compare", "compared", "report"]
