"""Reports: pages with tables, figures, theories and dialogues, and what is on them."""

from kille.lab.reports.folders import Report, compare, compare_results, report
from ttr.aliases import former_names

__all__ = ["Report", "compare", "compare_results", "report"]

__getattr__ = former_names(__name__, {"compared": "compare_results"})
