"""`polynya management RUN|STUDY`: what ice management did, by gates across the drift (docs/management.md)."""


def of_folder(folder, given):
    """The measures of a run's folder, by `collect.management` of a study."""
    from ..results.run import Run
    from .measures import measures_of

    return measures_of(Run(folder, pandas=False), given)
