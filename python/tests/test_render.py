"""Pictures and layers: what the arrays hold, and that drawing neither stops Python nor is stopped by it."""

import _thread
import io
import multiprocessing
import os
import struct
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest
from conftest import box

import cutaway

SIZE = (64, 48)


def test_a_picture_is_an_array_and_layers(scene):
    rgba, layers = scene.render(size=SIZE)
    assert rgba.shape == (48, 64, 4) and rgba.dtype == np.uint8
    for name, dtype, shape in [
        ("kind", np.uint8, (48, 64)),
        ("part", np.int32, (48, 64)),
        ("surface", np.int32, (48, 64)),
        ("depth", np.float32, (48, 64)),
        ("normal", np.float32, (48, 64, 3)),
        ("unreliable", np.bool_, (48, 64)),
        ("may_be_wrong", np.bool_, (48, 64)),
        ("overlap", np.bool_, (48, 64)),
    ]:
        array = getattr(layers, name)
        assert (array.dtype, array.shape) == (dtype, shape), name
        assert array.flags.owndata or array.base is not None
    assert layers.parts == ["cube"] and layers.surfaces == ["front"]


def test_layers_say_what_is_seen(scene):
    _, layers = scene.render(size=SIZE, position=[-4, 0.5, 0.5], orthographic=True)
    cap = layers.kind == layers.CAP
    assert cap.any()
    assert (layers.part[cap] == 0).all() and (layers.surface[cap] == 0).all()
    # The cap is at x = 0.5, and faces the eye.
    assert np.allclose(layers.depth[cap], 4.5, atol=1e-5)
    assert np.allclose(layers.normal[cap], [-1, 0, 0], atol=1e-6)
    background = layers.kind == layers.BACKGROUND
    assert np.isinf(layers.depth[background]).all()
    assert (layers.part[background] == -1).all() and (layers.surface[~cap] == -1).all()
    assert not layers.unreliable.any() and not layers.may_be_wrong.any()
    # From the other side there is no cap to be seen.
    _, behind = scene.render(size=SIZE, position=[4, 0.5, 0.5], orthographic=True)
    assert not (behind.kind == behind.CAP).any()


def test_a_picture_is_shown_by_a_notebook(scene, tmp_path):
    picture = scene.render(size=SIZE)
    png = picture._repr_png_()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">II", png[16:24]) == SIZE
    picture.save(tmp_path / "cut.png")
    assert (tmp_path / "cut.png").read_bytes() == png
    assert repr(picture).startswith("Picture(64x48")
    assert repr(picture.layers).startswith("Layers(64x48")
    image = pytest.importorskip("PIL.Image").open(io.BytesIO(png))
    assert np.array_equal(np.asarray(image), picture.rgba)


def test_a_picture_is_an_array_for_numpy(scene):
    picture = scene.render(size=SIZE)
    assert np.asarray(picture) is picture.rgba
    assert np.array(picture) is not picture.rgba
    assert np.asarray(picture, dtype=float).dtype == float
    assert np.mean(picture) > 0


@pytest.mark.parametrize("array", [np.zeros((4, 4, 3), np.uint8), np.zeros((4, 4, 4)), np.zeros((0, 4, 4), np.uint8), np.zeros(4, np.uint8)])
def test_what_is_no_picture_has_no_png(array):
    with pytest.raises(ValueError, match="help:"):
        cutaway.Picture(array).png()


def test_what_is_asked_for_one_picture_holds_for_it_alone(scene):
    before = str(scene)
    first = scene.render(size=SIZE)
    other = scene.render(size=(32, 32), strategy="exact", style="lit", supersample=1, background="transparent",
                         azimuth_deg=80, elevation_deg=5, set={"part.cube.material.color": "#ff0000"})  # fmt: skip
    assert other.rgba.shape == (32, 32, 4) and other.strategy == "exact"
    assert (other.rgba[..., 3] == 0).any(), "it is transparent where nothing is"
    assert str(scene) == before
    assert np.array_equal(first, scene.render(size=SIZE))


def test_strategies_agree(scene):
    kinds = [scene.render(size=SIZE, strategy=s).layers.kind for s in ("exact", "raycast+mask", "raycast+mask@compute", "stencil")]
    for kind in kinds[1:]:
        assert (kind != kinds[0]).sum() <= 2, "but for samples on an outline"


WRONG = {
    "an unknown strategy": ({"strategy": "raycats+mask"}, "raycast"),
    "an unknown style": ({"style": "technicl"}, "technical"),
    "no pixels": ({"size": (0, 10)}, "resolution"),
    "too many pixels": ({"size": (100_000, 100_000)}, "from 1 to 16384"),
    "negative": ({"size": (-4, 4)}, "resolution"),
    "one number": ({"size": 64}, "resolution"),
    "three numbers": ({"size": (1, 2, 3)}, "from 1 to 16384"),
    "no whole numbers": ({"size": (10.5, 10)}, "resolution"),
    "no finer": ({"supersample": 9}, "from 1 to 4"),
    "a time before": ({"time": -1}, "0 or more"),
    "no time": ({"time": float("nan")}, "not finite"),
    "no camera": ({"position": [1, 2]}, "camera"),
    "an eye where it looks": ({"position": [0, 0, 0], "focal_point": [0, 0, 0]}, "camera"),
    "no view": ({"view": "abov"}, "camera"),
    "an unknown path": ({"set": {"camera.azimut_deg": 3}}, "azimuth_deg"),
    "no path": ({"set": {3: 3}}, "no text"),
}


@pytest.mark.parametrize("words, message", WRONG.values(), ids=WRONG.keys())
def test_what_makes_no_sense_is_refused(scene, words, message):
    with pytest.raises(ValueError) as error:
        scene.render(**{"size": SIZE, **words})
    assert message in str(error.value) and "help:" in str(error.value)
    scene.render(size=SIZE)  # It goes on.


def test_a_keyword_that_there_is_not_is_named(scene):
    with pytest.raises(TypeError, match="azimuth_deg"):
        scene.render(size=SIZE, azimuth=3)


def test_a_strategy_that_refuses_says_why(scene):
    scene.cut("z=50%", relief="waves:amplitude=10%")
    with pytest.raises(ValueError, match="planar(.|\n)*help:"):
        scene.render(size=SIZE, strategy="planar")


def test_doubts_are_warnings():
    vertices, faces = box()
    scene = cutaway.Scene()
    scene.add("open", vertices, faces[2:])
    scene.cut("x=50%")
    with pytest.warns(cutaway.CutawayWarning, match="not closed(.|\n)*help:") as caught:
        scene.render(size=SIZE, view="cut")
    assert caught[0].filename == __file__, "it is said of the line that asked"
    with pytest.warns(cutaway.CutawayWarning, match="may be wrong(.|\n)*help:"):
        _, layers = scene.render(size=SIZE, view="cut", strategy="raycast+mask")
    assert layers.may_be_wrong.any() and layers.unreliable.any()
    closed = cutaway.Scene()
    closed.add("closed", vertices, faces)
    closed.cut("x=50%")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        closed.render(size=SIZE, view="cut")


def test_python_goes_on_while_it_is_drawn(scene):
    """Another thread counts meanwhile. Without the lock given back it would count next to nothing."""
    scene.render(size=SIZE)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begun = time.perf_counter()
    before = counted[0]
    scene.render(size=(1024, 768), strategy="exact")
    took, during = time.perf_counter() - begun, counted[0] - before
    done.set()
    thread.join()
    assert during > 20 * took, f"{during} counts in {took:.2f} s"


def child(queue):
    try:
        scene = cutaway.Scene("shape:cube")
        scene.render(size=(8, 8))
        queue.put("drawn")
    except Exception as error:
        queue.put(f"{type(error).__name__}: {error}")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks here")
@pytest.mark.parametrize("method, outcome", [("fork", "RuntimeError: this process was forked"), ("spawn", "drawn")])
def test_processes_that_were_forked_are_refused_and_do_not_hang(scene, method, outcome):
    scene.render(size=(8, 8))
    context = multiprocessing.get_context(method)
    queue = context.Queue()
    process = context.Process(target=child, args=(queue,))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        process.start()
    said = queue.get(timeout=60)
    process.join(10)
    assert said.startswith(outcome)


def test_without_a_driver_it_says_what_to_install(tmp_path):
    program = "import cutaway\ns = cutaway.Scene('shape:cube')\ntry:\n    s.render(size=(8, 8))\nexcept RuntimeError as e:\n    print(e)\nprint(s.section('z=50%').area)"
    environment = {**os.environ, "VK_DRIVER_FILES": str(tmp_path / "none.json"), "VK_ICD_FILENAMES": str(tmp_path / "none.json")}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True)
    assert "help:" in done.stdout, done
    assert done.stdout.strip().endswith("1.0"), "sections need none"


def test_the_adapter_has_a_name():
    about = cutaway.adapter()
    assert about["name"] and about["backend"] and isinstance(about["software"], bool)


def test_a_new_scene_draws_as_fast_as_one_that_was_drawn_before():
    """A cell of a notebook makes its scene anew each time; what the device compiled for an earlier cell is used again."""
    vertices, faces = box()

    def seconds(draw):
        times = []
        for _ in range(5):
            begun = time.perf_counter()
            draw()
            times.append(time.perf_counter() - begun)
        return min(times)

    def cell():
        scene = cutaway.Scene()
        scene.add("box", vertices, faces)
        scene.cut("x=50%", relief="fractal:amplitude=4%,size=64")
        scene.render(size=(32, 24))
        return scene

    drawn = cell()
    # A ratio, because it holds on slow machines too; of small pictures, beside which compiling takes twenty times as long (0.5 s to 0.02 s).
    new, again = seconds(cell), seconds(lambda: drawn.render(size=(32, 24)))
    print(f"new scene: {new:.3f} s, the same scene again: {again:.3f} s")
    assert new < 2 * again


def test_an_interrupt_is_raised_within_a_second(scene):
    began = time.monotonic()
    threading.Timer(0.5, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        scene.render(size=(3000, 2000), strategy="exact", supersample=1)
    assert time.monotonic() - began < 1.5
    # It waits for what the other call still does.
    assert scene.render(size=(8, 8)).rgba.shape == (8, 8, 4)
    assert time.monotonic() - began > 1.5, "the control: the picture takes longer than that"


@pytest.mark.skipif(sys.platform != "linux", reason="what a process has is read where Linux says it")
def test_memory_does_not_grow_with_the_number_of_pictures(scene):
    def pages():
        with open("/proc/self/statm") as statm:
            return int(statm.read().split()[1])

    held = []
    for number in range(90):
        scene.render(size=(96, 72))
        if number in (29, 89):
            held.append(pages() * os.sysconf("SC_PAGE_SIZE") / 60)
    assert held[1] - held[0] < 200_000, "bytes a picture"
