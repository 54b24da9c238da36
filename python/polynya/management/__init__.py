"""`polynya management RUN|STUDY`: measures the effect of ice management at gates across the drift
(docs/management.md)."""


def of_folder(folder, given):
    """Measures of a run's folder for `collect.management` of a study."""
    from ..results.run import Run
    from .measures import measures_of

    return measures_of(Run(folder, pandas=False), given)
