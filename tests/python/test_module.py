"""The compiled module: the command line's bits, from Python."""
import ast
import concurrent.futures
import gc
import json
import os
import re
import signal
import subprocess
import sys
import threading
import weakref

import numpy
import pytest

import polynya
from program import BREAKER, ICE, SCENES, lines, rows, run_of, succeeded

SOURCE_PACKAGE = SCENES.parent / "python"
SEA = {
    "time": {"step_s": 0.05, "until_s": 60},
    "ships": [{"name": "sailing",
               "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27,
                        "draught_m": 6, "block_coefficient": 0.579},
               "speed_m_per_s": 6, "propulsion": {"engine": {"bollard_pull_kN": 314, "open_water_speed_m_per_s": 6}},
               "steering": {"rudder": {"area_m2": 13}}}],
}


OTHER = {**SEA["ships"][0], "name": "other", "position_m": [0, 400]}
ENDLESS = {**SEA, "time": {"step_s": 0.05, "until_s": 1e6}}  # steps until it is stopped, in no time each


@pytest.fixture(scope="module")
def command_lines_run(tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("run"), "run", ICE)


def test_state_events_and_forces_are_those_of_the_command_line(command_lines_run):
    simulation = polynya.Simulation(ICE)
    for row in rows(command_lines_run / "states.csv"):
        simulation.run(until=float(row["t_s"]))
        assert (simulation.steps, simulation.state_hash) == (int(row["steps"]), row["state_hash"])
    events = lines(command_lines_run / "events.ndjson")
    assert any(event["kind"] == "bend" for event in events)
    assert simulation.events() == events
    assert simulation.events() == []
    written = rows(command_lines_run / "forces.csv")[-1]
    forces = simulation.ships[0].forces
    assert {key: forces[key] for key in written if key != "ship"} == {
        key: pytest.approx(float(value), rel=1e-5) for key, value in written.items() if key != "ship"}


def test_a_saved_simulation_continues_bit_for_bit():
    whole, first = polynya.Simulation(ICE), polynya.Simulation(ICE)
    whole.run(until=6)
    first.run(until=3)
    second = polynya.Simulation.resume(ICE, first.save())
    assert (second.time, second.state_hash) == (first.time, first.state_hash)
    second.run(until=6)
    assert second.state_hash == whole.state_hash
    with pytest.raises(ValueError, match="another scene"):
        polynya.Simulation.resume(SEA, first.save())
    damaged = bytearray(first.save())
    damaged[len(damaged) // 2] ^= 1
    with pytest.raises(ValueError, match="cannot resume"):
        polynya.Simulation.resume(ICE, bytes(damaged))


def test_a_scene_from_a_dict_a_text_and_a_file_is_the_same(tmp_path):
    file = tmp_path / "scene.json"
    file.write_text("// a comment\n" + json.dumps(ICE))
    hashes = {polynya.Scene(given).hash for given in (ICE, json.dumps(ICE), file, str(file))}
    assert len(hashes) == 1
    with_numpy = {**ICE,
                  "floes": [{"rectangle": {"corner_m": numpy.array([0.0, -40.0]), "size_m": (numpy.float64(120), 80)}}]}
    assert polynya.Scene(with_numpy).hash in hashes
    assert polynya.Scene(ICE).resolved["ice"]["thickness_m"] > 0


def test_a_wrong_scene_lists_its_problems_with_their_places(tmp_path):
    wrong = {**ICE, "ice": {"thicknes_m": 1, "friction": -1}}
    problems = polynya.Scene(wrong).validate()
    assert {problem.path for problem in problems} == {"ice.thicknes_m", "ice.friction"}
    assert all(problem.severity == "error" and problem.line is None for problem in problems)
    with pytest.raises(polynya.SceneError) as raised:
        polynya.Simulation(wrong)
    assert raised.value.problems == problems
    assert "ice.friction" in str(raised.value)
    of_text = polynya.Scene(json.dumps(wrong, indent=1)).validate()
    lines = json.dumps(wrong, indent=1).splitlines()
    assert all(problem.path.split(".")[1] in lines[problem.line - 1] for problem in of_text)
    friction = next(problem for problem in of_text if problem.path == "ice.friction")
    assert friction.found == "-1" and friction.allowed
    assert [problem.severity for problem in polynya.Scene('{"floes": ').validate()] == ["error"]
    with pytest.raises(FileNotFoundError):
        polynya.Scene(tmp_path / "none.json")


@pytest.mark.parametrize("wrong, error", [
    (lambda: polynya.Scene(3), TypeError),
    (lambda: polynya.Scene({"seed": object()}), TypeError),
    (lambda: polynya.Scene({"seed": float("nan")}), ValueError),
    (lambda: polynya.Simulation(None), TypeError),
    (lambda: polynya.Simulation(SEA, threads=0), ValueError),
    (lambda: polynya.Simulation(SEA).step(-1), ValueError),
    (lambda: polynya.Simulation(SEA).step(1.5), TypeError),
    (lambda: polynya.Simulation(SEA).run(until=float("nan")), ValueError),
    (lambda: polynya.Simulation(SEA).run(until=1, progress=3), TypeError),
    (lambda: polynya.Simulation(SEA).set_pilot(1, print), IndexError),
    (lambda: polynya.Simulation(SEA).set_pilot("none", print), ValueError),
    (lambda: polynya.Simulation(SEA).set_pilot(0, 3), TypeError),
    (lambda: polynya.Simulation(ICE).set_pilot(0, print), ValueError),
])
def test_wrong_arguments_are_refused(wrong, error):
    with pytest.raises(error):
        wrong()


@pytest.mark.parametrize("more, path", [
    ({"ships": [{**BREAKER, "hull": {**BREAKER["hull"], "beam_m": float("nan")}}]}, "ships[0].hull.beam_m: found nan"),
    ({"seed": float("inf")}, "seed: found inf"),
    ({"floes": [{"polygon": {"outer_m": numpy.array([[0, 0], [1, float("nan")]])}}]},
     "floes[0].polygon.outer_m[1][1]: found nan"),
])
def test_a_number_that_is_none_is_named_by_its_path(more, path):
    with pytest.raises(ValueError, match="^" + re.escape(path) + ", allowed: a finite number"):
        polynya.Scene({**ICE, **more})


def test_ships_are_found_by_index_and_by_name():
    ships = polynya.Simulation({**SEA, "ships": [*SEA["ships"], OTHER]}).ships
    assert ships["other"] is ships[1] is ships[-1] and len(ships) == 2
    assert [ship.name for ship in ships[:1]] == ["sailing"]
    with pytest.raises(KeyError, match="titanic; there are sailing, other"):
        ships["titanic"]


def test_the_version_is_the_programs_with_and_without_the_compiled_module():
    version = succeeded("--version").stdout.split()[1]
    assert polynya.__version__ == version
    code = "import polynya; print(polynya.__version__)"
    alone = subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": str(SOURCE_PACKAGE)},
                           check=True, capture_output=True, text=True)
    assert alone.stdout.strip() == version


def rings_of(floes):
    """Of each floe its rings in the world."""
    return [[floes.world_vertices[floes.ring_offsets[r]:floes.ring_offsets[r + 1]]
             for r in range(floes.floe_offsets[i], floes.floe_offsets[i + 1])] for i in range(len(floes))]


def test_floes_are_arrays_of_one_length():
    simulation = polynya.Simulation(ICE)
    simulation.run()
    floes = simulation.floes
    count = len(floes)
    assert count > 2 and any(event["kind"] == "bend" for event in simulation.events())
    for name in ("ids", "parents", "generations", "is_under", "thickness", "areas", "masses"):
        assert getattr(floes, name).shape == (count,)
    assert floes.poses.shape == floes.velocities.shape == (count, 3)
    assert floes.floe_offsets.shape == (count + 1,) and floes.floe_offsets[-1] == len(floes.ring_offsets) - 1
    assert floes.vertices.shape == floes.world_vertices.shape == (floes.ring_offsets[-1], 2)
    assert (numpy.diff(floes.ids) > 0).all()
    density = polynya.Scene(ICE).resolved["ice"]["density_kg_per_m3"]
    numpy.testing.assert_allclose(floes.masses, density * floes.thickness * floes.areas, rtol=1e-12)
    for rings, wanted in zip(rings_of(floes), floes.areas):  # each shape has the area that is given for it
        area = 0
        for x, y in ((ring - ring[0]).T for ring in rings):
            area += 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
        assert area == pytest.approx(wanted, rel=1e-9)
    ship = simulation.ships[0]
    assert ship.name == "breaker" and ship.position.shape == ship.velocity.shape == (2,)
    ship.position[0] = floes.poses[0, 0] = 1e9  # copies
    assert simulation.ships[0].position[0] < 1e3 and simulation.floes.poses[0, 0] < 1e3


def test_a_python_pilot_steers():
    seen = []

    def to_port(view):
        seen.append((view.time, view.position, view.lever, len(view.ships), view.ice_force))
        return (0.5, view.steering_most)

    simulation = polynya.Simulation(SEA)
    simulation.set_pilot("sailing", to_port)
    simulation.step(400)
    assert len(seen) == 400 and seen[1][0] == pytest.approx(0.05)
    assert simulation.ships[0].heading > 0.1 and simulation.ships[0].lever == pytest.approx(0.5)
    simulation.set_pilot(0, None)
    simulation.step()
    assert len(seen) == 400


def test_each_ship_may_have_its_own_pilot():
    simulation = polynya.Simulation({**SEA, "ships": [*SEA["ships"], OTHER]})
    seen = {"sailing": [], "other": []}

    def turning(name, share):
        def pilot(view):
            seen[name].append((view.ship, view.ships[view.ship].position))
            return 1.0, share * view.steering_most
        return pilot

    simulation.set_pilot("sailing", turning("sailing", 1))
    simulation.set_pilot(1, turning("other", -1))
    simulation.step(400)
    assert [len(calls) for calls in seen.values()] == [400, 400]
    assert [calls[0][0] for calls in seen.values()] == [0, 1] and seen["other"][0][1] == (0, 400)
    port, starboard = (ship.heading for ship in simulation.ships)
    assert port > 0.1 and starboard == pytest.approx(-port, rel=1e-6)


def test_what_a_pilot_raises_comes_out_of_step_after_a_whole_step():
    simulation = polynya.Simulation(SEA)
    simulation.set_pilot(0, lambda view: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulation.step(10)
    assert simulation.steps == 1
    for wrong in ((1,), "ab", 3, (float("nan"), 0)):
        simulation.set_pilot(0, lambda view: wrong)
        with pytest.raises((TypeError, ValueError)):
            simulation.step()
    simulation.set_pilot(0, lambda view: None)
    simulation.step(5)
    assert simulation.steps == 10


def test_a_pilot_reads_its_simulation_but_does_not_step_it():
    simulation = polynya.Simulation(SEA)
    positions = []

    def curious(view):
        positions.append((view.position[0], simulation.ships[0].position[0], len(simulation.floes)))
        simulation.step()

    simulation.set_pilot(0, curious)
    with pytest.raises(RuntimeError, match="being stepped"):
        simulation.step()
    assert positions[0][0] == positions[0][1]
    memory = simulation.floe_memory
    for touch in (simulation.save, lambda: memory.centres):
        simulation.set_pilot(0, lambda view: touch())
        with pytest.raises(RuntimeError, match="being stepped"):
            simulation.step()


def test_progress_is_called_and_ends_the_run_where_it_raises():
    times = []
    simulation = polynya.Simulation(SEA)
    simulation.run(until=2, progress=times.append)
    assert times[-1] == pytest.approx(2) and simulation.steps == 40

    def stop(at):
        raise StopIteration(at)

    with pytest.raises(StopIteration):
        polynya.Simulation(ENDLESS).run(progress=stop)


def test_ctrl_c_ends_a_run_between_two_steps():
    code = """if True:
        import json, polynya, sys
        simulation = polynya.Simulation(json.loads(sys.argv[1]))
        words = iter(["running"])
        try:
            simulation.run(progress=lambda time: [print(word, flush=True) for word in words])
        except KeyboardInterrupt:
            before = simulation.steps
            simulation.step(3)
            print(simulation.steps - before)"""
    words = [sys.executable, "-c", code, json.dumps(ENDLESS)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "running\n"
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=60)[0] == "3\n"
        assert process.returncode == 0


def test_two_simulations_in_two_threads_give_the_same_state():
    alone = polynya.Simulation(ICE)
    alone.run(until=5)
    pair = [polynya.Simulation(ICE), polynya.Simulation(ICE)]
    with concurrent.futures.ThreadPoolExecutor(2) as threads:
        list(threads.map(lambda simulation: simulation.run(until=5), pair))
    assert {simulation.state_hash for simulation in pair} == {alone.state_hash}


def test_the_interpreter_runs_while_a_simulation_steps_and_may_not_touch_it():
    simulation = polynya.Simulation(ENDLESS)
    is_running, is_enough = threading.Event(), False

    def progress(at):
        is_running.set()
        if is_enough:
            raise StopIteration

    def run():
        with pytest.raises(StopIteration):
            simulation.run(progress=progress)

    thread = threading.Thread(target=run)
    thread.start()
    assert is_running.wait(60)
    for touch in (lambda: simulation.time, lambda: simulation.floes, simulation.step,
                  simulation.save, simulation.events):
        with pytest.raises(RuntimeError, match="being stepped"):
            touch()
    is_enough = True
    thread.join(60)
    assert not thread.is_alive() and simulation.time > 0


def test_a_simulation_that_its_pilot_refers_to_is_collected_in_another_thread():
    class Captain:
        def __call__(self, view):
            return None

    captain = Captain()
    captain.simulation = polynya.Simulation(SEA)
    captain.simulation.set_pilot(0, captain)
    captain.simulation.step(3)
    alive = weakref.ref(captain)
    del captain
    collector = threading.Thread(target=gc.collect)
    collector.start()
    collector.join()
    assert alive() is None


def test_views_of_the_simulations_own_memory_are_what_the_copies_are():
    simulation = polynya.Simulation({**ICE, "water": {"drift_m_per_s": [0.2, -0.1]}})
    simulation.run(until=6)
    copies, memory = simulation.floes, simulation.floe_memory
    alive = memory.is_alive
    assert alive.dtype == bool and len(alive) == len(memory) > len(copies)
    assert numpy.flatnonzero(alive).tolist() == copies.ids.tolist()
    for name in ("parents", "generations", "areas", "masses", "thickness", "is_under"):
        numpy.testing.assert_array_equal(getattr(memory, name)[alive], getattr(copies, name))
    numpy.testing.assert_allclose(memory.velocities[alive] + memory.water_velocity,
                                  copies.velocities[:, :2], rtol=1e-12, atol=1e-15)
    numpy.testing.assert_array_equal(memory.turning[alive], copies.velocities[:, 2])
    numpy.testing.assert_array_equal(memory.angles[alive], copies.poses[:, 2])
    c, s = numpy.cos(copies.poses[:, 2]), numpy.sin(copies.poses[:, 2])
    x, y = memory.centroids[alive].T
    centres = copies.poses[:, :2] + numpy.column_stack((c * x - s * y, s * x + c * y))
    # A rotation is turned step by step, so that it and its angle differ by the rounding of their steps.
    numpy.testing.assert_allclose(memory.centres[alive] + memory.water_shift, centres, atol=1e-5)
    for i, floe in enumerate(copies.ids):
        first = copies.ring_offsets[copies.floe_offsets[i]]
        rings = memory.shape(floe)
        numpy.testing.assert_array_equal(numpy.concatenate(rings),
                                         copies.vertices[first:copies.ring_offsets[copies.floe_offsets[i + 1]]])
    with pytest.raises(ValueError, match="has broken"):
        memory.shape(int(numpy.flatnonzero(~alive)[0]))
    with pytest.raises(IndexError):
        memory.shape(len(memory))


def test_views_share_memory_and_cannot_be_written():
    memory = polynya.Simulation(ICE).floe_memory
    assert numpy.shares_memory(memory.centres, memory.centres)
    for array in (memory.centres, memory.areas, memory.is_alive, memory.shape(0)[0]):
        assert not array.flags.owndata
        with pytest.raises(ValueError):
            array[0] = 1
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_a_simulation_is_not_stepped_while_a_view_of_it_lives():
    simulation = polynya.Simulation(ICE)
    part = simulation.floe_memory.centres[0]
    for step in (simulation.step, simulation.run):
        with pytest.raises(BufferError, match="delete them, or copy"):
            step()
    assert simulation.steps == 0 and simulation.save() and simulation.floes is not None
    copied = part.copy()
    del part
    simulation.step(3)
    assert simulation.steps == 3 and copied.shape == (2,)


def test_views_and_what_has_them_keep_their_simulation():
    simulation = polynya.Simulation(ICE)
    before = sys.getrefcount(simulation)
    memory = simulation.floe_memory
    assert sys.getrefcount(simulation) == before + 1
    part = memory.centres[0]
    assert sys.getrefcount(simulation) == before + 2
    del memory
    assert sys.getrefcount(simulation) == before + 1
    del part
    assert sys.getrefcount(simulation) == before


def test_a_view_outlives_its_simulation():
    simulation = polynya.Simulation(ICE)
    areas, shape = simulation.floe_memory.areas, simulation.floe_memory.shape(0)[0]
    before = areas.copy(), shape.copy()
    alive = weakref.ref(simulation) if hasattr(simulation, "__weakref__") else None
    del simulation
    gc.collect()
    polynya.Simulation(ICE).step(10)  # takes memory
    assert alive is None or alive() is not None
    numpy.testing.assert_array_equal(areas, before[0])
    numpy.testing.assert_array_equal(shape, before[1])


def covered(polygons, pose, shape, cell, ahead, lines=8):
    """The share of each cell that polygons cover: points of a fine grid in them."""
    from matplotlib.path import Path
    rows, columns = shape
    along = ahead + cell * (rows / 2 - (numpy.arange(rows * lines) + 0.5) / lines)
    across = cell * (columns / 2 - (numpy.arange(columns * lines) + 0.5) / lines)
    grid = numpy.stack(numpy.meshgrid(along, across, indexing="ij"), axis=-1).reshape(-1, 2)
    x, y, angle = pose
    c, s = numpy.cos(angle), numpy.sin(angle)
    points = grid @ numpy.array([[c, s], [-s, c]]) + (x, y)
    inside = numpy.zeros(len(points), dtype=bool)
    for rings in polygons:
        odd = numpy.zeros(len(points), dtype=bool)
        for ring in rings:
            odd ^= Path(ring).contains_points(points)
        inside |= odd
    return inside.reshape(rows, lines, columns, lines).mean(axis=(1, 3))


def test_the_occupancy_image_is_the_share_of_each_cell_that_is_covered():
    pytest.importorskip("matplotlib")
    turned = {**BREAKER, "heading_deg": 25, "position_m": [-40, -20]}
    other = {**BREAKER, "name": "other", "position_m": [20, 90], "heading_deg": 100}
    holed = {"polygon": {"outer_m": [[-60, 30], [-20, 30], [-20, 60], [-60, 60]],
                         "holes_m": [[[-50, 36], [-30, 36], [-30, 54], [-50, 54]]]}}
    scene = {**ICE, "ships": [turned, other], "floes": [*ICE["floes"], holed]}
    simulation = polynya.Simulation(scene)
    simulation.run(until=3)
    floes, ship = simulation.floes, simulation.ships[0]
    image = simulation.occupancy("breaker", shape=(40, 60), cell_m=3, ahead_m=30)
    assert image.shape == (2, 40, 60) and image.dtype == numpy.float32
    expected = covered(rings_of(floes), (*ship.position, ship.heading), (40, 60), 3, 30)
    assert 0.2 < expected.mean() < 0.8 and image[1].sum() > 0
    assert numpy.abs(image[0] - expected).max() < 0.2 and numpy.abs(image[0] - expected).mean() < 0.005
    whole = simulation.occupancy(1, shape=(400, 400), cell_m=1.0)  # all ice is within it
    assert whole[0].sum() == pytest.approx(floes.areas.sum(), rel=2e-3)
    assert whole[1].sum() == pytest.approx(60 * 14 - 7 * 7 / numpy.tan(numpy.radians(30)), rel=1e-2)
    for wrong in ({"shape": (0, 3)}, {"shape": (9999, 3)}, {"cell_m": 0}, {"cell_m": float("nan")},
                  {"ahead_m": float("inf")}):
        with pytest.raises(ValueError):
            simulation.occupancy(**wrong)
    with pytest.raises(IndexError):
        simulation.occupancy(7)
    with pytest.raises(TypeError):
        simulation.occupancy(shape="ab")


def test_the_image_has_the_way_ahead_on_top_and_port_on_the_left():
    ship = {**BREAKER, "position_m": [0, 0], "heading_deg": 90}
    floe = {"rectangle": {"corner_m": [-70, 100], "size_m": [10, 10]}}  # ahead, to port
    image = polynya.Simulation({**ICE, "ships": [ship], "floes": [floe]}).occupancy(shape=(60, 60), cell_m=5)[0]
    rows, columns = numpy.nonzero(image)
    assert rows.tolist() == [8, 8, 9, 9] and columns.tolist() == [16, 17, 16, 17] and image.max() == 1


def test_the_last_reference_may_be_dropped_in_another_thread():
    kept = [polynya.Simulation(ICE)]
    kept[0].run(until=2)
    kept.append(kept[0].floe_memory.centres)
    dropping = threading.Thread(target=kept.clear)
    other = polynya.Simulation(ICE)
    dropping.start()
    other.run(until=2)
    dropping.join()
    assert not kept and other.steps == 200


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_the_stub_has_every_public_name_and_each_has_a_docstring():
    from polynya import _core
    stub = {node.name: node for node in ast.parse((SOURCE_PACKAGE / "polynya" / "_core.pyi").read_text()).body
            if hasattr(node, "name")}
    assert public(vars(_core)) == public(stub)
    for name in public(vars(_core)):
        compiled = getattr(_core, name)
        assert compiled.__doc__
        if isinstance(compiled, type):
            assert public(vars(compiled)) == public(member.name for member in stub[name].body)
            assert all(getattr(compiled, member).__doc__ for member in public(vars(compiled)))
    assert public(dir(polynya)) >= set(polynya.__all__)


def test_without_the_module_studies_work_and_the_error_names_what_to_do():
    code = ("import polynya, polynya.study\n"
            "try:\n    polynya.Simulation\nexcept ImportError as error:\n    print(error)\n")
    environment = {**os.environ, "PYTHONPATH": str(SOURCE_PACKAGE)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert "./quickstart" in done.stdout
