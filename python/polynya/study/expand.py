"""Lists the cases of a study: every combination of scenes, grid, pairs and draws, repeated with other seeds."""
import itertools

from . import draws


def count_cases(definition):
    """The number of cases that expand() lists, without listing them. `definition` is a definition.Definition, here and
    below."""
    count = definition.repetitions * definition.draws * len(definition.scenes) * paired_count(definition)
    for values in definition.grid.values():
        count *= len(values)
    return count


def paired_count(definition):
    """The number of rows of the paired values, which all have the same length; 1 if there are none. The rows of a
    design are paired values too."""
    return len(next(iter(definition.paired.values()), [None]))


def expand(definition):
    """Yields every case in the order of its number, as the index of its scene and its values by path, without those
    that the study sets for all cases. The last path of the grid varies fastest, then the other paths of the grid,
    pairs, scenes, draws, and slowest the repetitions. A study with more repetitions therefore begins with the same
    cases, so that finished cases can be kept; so does a study of one repetition with more independent draws. With a
    Latin hypercube more draws change all cases. No path is in two of these groups: the definition was checked."""
    drawn = {
        path: draws.draw(definition.draw_seed, path, kind, numbers, definition.draws, definition.method)
        for path, (kind, numbers) in definition.draw.items()
    }
    has_own_seeds = repeats_by_seed(definition)
    grid_paths, pairs = list(definition.grid), range(paired_count(definition))
    for repetition in range(definition.repetitions):
        for k in range(definition.draws):
            for scene in range(len(definition.scenes)):
                for pair in pairs:
                    for values in itertools.product(*definition.grid.values()):
                        case = dict(zip(grid_paths, values))
                        case.update((path, column[pair]) for path, column in definition.paired.items())
                        case.update((path, column[k]) for path, column in drawn.items())
                        if has_own_seeds:
                            case["seed"] = definition.seed + repetition
                        yield scene, case


def repeats_by_seed(definition):
    """Returns True if repetitions set the scene's seed, because nothing else in the study sets it. Otherwise the
    repetitions of a case are equal."""
    blocks = (definition.fixed, definition.grid, definition.paired, definition.draw)
    return not any("seed" in block for block in blocks)


def varied_paths(definition):
    """The paths that have values of their own in each case, in the order of the study; these become columns of its
    table. "seed" is one of them if repetitions set it, even if there is only one repetition."""
    paths = [*definition.grid, *definition.paired, *definition.draw]
    return [*paths, "seed"] if repeats_by_seed(definition) else paths
