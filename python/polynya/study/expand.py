"""Lists the cases of a study: every combination of scenes, grid, pairs and draws, repeated with other seeds."""
import itertools

from . import draws


def count_cases(definition):
    count = definition.repetitions * definition.draws * len(definition.scenes) * paired_count(definition)
    for values in definition.grid.values():
        count *= len(values)
    return count


def paired_count(definition):
    return len(next(iter(definition.paired.values()), [None]))


def expand(definition):
    """Every case in the order of its number: its scene, and the values by path. Repetitions are the outermost loop and
    draws the next one, so that a study with more of them begins with the cases of a smaller study."""
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
    """Returns True if repetitions set the scene's seed, because nothing else in the study sets it."""
    blocks = (definition.fixed, definition.grid, definition.paired, definition.draw)
    return not any("seed" in block for block in blocks)


def varied_paths(definition):
    """Paths that differ between cases, in the order of the study."""
    paths = [*definition.grid, *definition.paired, *definition.draw]
    return [*paths, "seed"] if repeats_by_seed(definition) else paths
