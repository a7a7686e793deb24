"""Former import path of `loiter.guidance.trials.summary`, given in earlier documentation."""

from loiter.guidance.trials.summary import CampaignSummary, summary

# The former name of `CampaignSummary`.
Summary = CampaignSummary

__all__ = ["CampaignSummary", "Summary", "summary"]
