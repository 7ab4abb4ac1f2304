"""Strategies compared: the numbers of the command, as a dict."""

import _thread
import threading

import pytest

import cutaway


def test_numbers_are_those_of_the_json(scene):
    found = scene.compare(["raycast+mask", "grid:8+vds:64"], size=(64, 48), rounds=2, view="cut")
    assert found["resolution"] == [64, 48] and found["triangles"] == 12
    exact, coarse = found["strategies"]
    assert exact["name"] == "raycast+mask" and exact["outcome"] == "complete"
    assert exact["decided_wrong_px"] == 0
    assert coarse["name"] == "grid:8+vds:64"
    assert len(exact["time_ms"]["frame"]["samples"]) == 2
    assert found["exact"]["cap_px"] > 0
    assert found["command"].startswith("scene.compare(['raycast+mask'")
    assert found["adapter"]["name"] == cutaway.adapter()["name"]


def test_a_strategy_that_refuses_is_an_outcome(scene):
    scene.cut("z=50%", relief="waves:amplitude=10%")
    (planar,) = scene.compare(["planar"], size=(32, 24), rounds=1)["strategies"]
    assert planar["outcome"] == "refused" and planar["reason"]


def test_a_strategy_named_twice_is_measured_once(scene):
    assert len(scene.compare(["stencil", "stencil"], size=(32, 24), rounds=1)["strategies"]) == 1


WRONG = {
    "unknown": ((["raycats+mask"],), {}, "did you mean"),
    "exact": ((["exact"],), {}, "measured against"),
    "none": (([],), {}, "none to compare"),
    "no text": (([3],), {}, "no text"),
    "no list": ((3,), {}, "help:"),
    "no rounds": (("stencil",), {"rounds": 0}, "rounds"),
    "too many rounds": (("stencil",), {"rounds": 10**9}, "rounds"),
    "rounds that are no number": (("stencil",), {"rounds": "some"}, "rounds"),
    "too much memory": (("all",), {"size": (16_384, 16_384)}, "memory"),
}


@pytest.mark.parametrize("names, words, message", WRONG.values(), ids=WRONG.keys())
def test_what_makes_no_sense_is_refused(scene, names, words, message):
    with pytest.raises(ValueError) as error:
        scene.compare(*names, **words)
    assert message in str(error.value) and "help:" in str(error.value)


def test_an_interrupt_ends_it(scene):
    threading.Timer(1.0, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        scene.compare(["raycast+mask"], size=(256, 192), rounds=10_000)
    scene.render(size=(8, 8))
