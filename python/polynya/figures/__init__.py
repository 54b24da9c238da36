"""Figures of runs for print, by matplotlib (docs/figures.md): `polynya figures RUN`, and from Python

    from polynya.figures import loads, page
    figure = loads.draw([polynya.Run("runs/sawamura2017-fig4b")], page.Page(page.ONE_COLUMN))
    figure.savefig("loads.pdf")

`maps`, `loads`, `motion`, `sizes` and `energy` each have a `draw(runs, page, …)` that returns a matplotlib Figure of
its size on paper, or None where the runs have nothing of the kind.
"""
