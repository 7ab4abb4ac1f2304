"""Scenes are documents: they are read, changed and saved, and a change that makes no sense leaves them as they were."""

import copy
import os
import pickle
import threading

import numpy as np
import pytest
from conftest import box

import cutaway


def test_values_are_set_and_found(scene):
    scene.set("camera.azimuth_deg", 20)
    assert scene.get("camera.azimuth_deg") == 20
    scene.set("part.cube.translate", np.array([1.0, 2.0, 3.0]))
    assert scene.get("part.cube.translate") == [1.0, 2.0, 3.0]
    scene.set("part.cube.material", {"color": "#ff8800"})
    assert scene.get("part.cube.material.color") == "#ff8800"
    assert scene.get("cut.front.surfaces.0.section") == "x=50%"
    scene.remove("part.cube.translate")
    with pytest.raises(ValueError):
        scene.get("part.cube.translate")


def test_a_relief_is_changed_by_its_path(scene):
    scene.cut("z=50%", relief="fractal:amplitude=4%", name="ragged")
    scene.set("cut.ragged.surfaces.0.amplitude", 0.1)
    assert scene.get("cut.ragged.surfaces.0.amplitude") == 0.1


def ends_of_ranges():
    """Numbers at the ends of the ranges of a style and of a camera, and just beyond: path, number, and whether it is taken."""
    for about in cutaway.values():
        path, one = about["path"], about["range"]
        if one is None or not path.startswith(("style.", "camera.")) or "numbers" in about["takes"]:
            continue
        if path in ("camera.height", "style.hatch.least", "style.hatch.most"):  # Other values limit them too.
            continue
        step = 1 if about["takes"].startswith("whole") else 1e-3
        for end, beyond in zip(one, (-step, step)):
            if 1e-9 < abs(end) < 1e9 or end == 0:
                number = int(end) if step == 1 else end
                yield path, number, True
                yield path, number + beyond, False


def test_published_ranges_are_those_that_are_checked(scene):
    probed = 0
    for path, number, is_taken in ends_of_ranges():
        probed += 1
        if is_taken:
            scene.set(path, number)
            scene.remove(path)
        else:
            with pytest.raises(ValueError, match="help:"):
                scene.set(path, number)
    assert probed > 80


def a_list_in_itself():
    endless = []
    endless.append(endless)
    return endless


WRONG_VALUES = {
    "unknown key": ("camera.azimut_deg", 20, "azimuth_deg"),
    "unknown part": ("part.cub.scale", 2, "cube"),
    "text for a number": ("camera.azimuth_deg", "left", "camera.azimuth_deg"),
    "nan": ("camera.azimuth_deg", float("nan"), "not finite"),
    "inf": ("camera.azimuth_deg", np.float32(np.inf), "not finite"),
    "None": ("camera.azimuth_deg", None, "no value of a scene"),
    "an object": ("camera.azimuth_deg", object(), "no value of a scene"),
    "complex": ("camera.azimuth_deg", 1j, "no value of a scene"),
    "beyond 64 bits": ("camera.azimuth_deg", 2**70, "beyond 64 bits"),
    "endless": ("camera.position", a_list_in_itself(), "without end"),
    "half a character": ("part.cube.name", "\ud800", "Unicode"),
    "no path": ("", 1, "names no value"),
    "wrong number of numbers": ("part.cube.translate", [1, 2], "help:"),
    "a singular matrix": ("part.cube.scale", 0, "help:"),
}


@pytest.mark.parametrize("path, value, words", WRONG_VALUES.values(), ids=WRONG_VALUES.keys())
def test_values_that_make_no_sense_change_nothing(scene, path, value, words):
    before = str(scene)
    with pytest.raises(ValueError) as error:
        scene.set(path, value)
    assert words in str(error.value)
    assert "help:" in str(error.value)
    assert str(scene) == before


@pytest.mark.parametrize("path", [3, None, b"camera", ["camera"]])
def test_paths_are_texts(scene, path):
    with pytest.raises(ValueError, match="no text"):
        scene.set(path, 1)
    with pytest.raises(ValueError, match="no text"):
        scene.get(path)


WRONG_CUTS = {
    "no plane": (("q=3",), {}, "q=3"),
    "no number": (("x=",), {}, "x="),
    "nothing": ((), {}, "nothing to cut by"),
    "no text": ((3,), {}, "no text"),
    "unknown relief": (("x=50%",), {"relief": "fractl"}, "fractal"),
    "unknown word of a relief": (("x=50%",), {"relief": "fractal:amplitud=4%"}, "amplitude"),
    "a relief without a section": ((), {"box": "0,0,0:1,1,1", "relief": "waves"}, "1 for 0 sections"),
    "too few reliefs": (("x=50%", "y=50%"), {"relief": ["waves"]}, "1 for 2 sections"),
    "a wrong box": ((), {"box": "0,0"}, "help:"),
    "a wrong wedge": ((), {"wedge": "q:0:90"}, "help:"),
    "an unknown key": (("x=50%",), {"offst": 3}, "help:"),
    "globs that are no text": (("x=50%",), {"exclude": [3]}, "no text"),
}


@pytest.mark.parametrize("sections, words, message", WRONG_CUTS.values(), ids=WRONG_CUTS.keys())
def test_cuts_that_make_no_sense_change_nothing(scene, sections, words, message):
    before = str(scene)
    with pytest.raises(ValueError) as error:
        scene.cut(*sections, **words)
    assert message in str(error.value)
    assert "help:" in str(error.value)
    assert str(scene) == before


def volume(*sections, **words):
    scene = cutaway.Scene()
    scene.add("cube", *box())
    scene.cut(*sections, **words)
    return scene.capped().volume


def test_words_of_one_call_remove_what_all_of_them_do():
    assert volume("x=50%") == pytest.approx(1 / 2)
    assert volume("-x=25%") == pytest.approx(1 / 4)
    assert volume("-x=25%", flip=True) == pytest.approx(3 / 4)
    assert volume("x=50%", "y=50%") == pytest.approx(3 / 4)
    assert volume("x=50%", "y=75%", flip=[False, True]) == pytest.approx(1 - 0.5 * 0.25)
    assert volume(box="50%,50%,50%:") == pytest.approx(7 / 8)
    assert volume(box=["50%,50%,50%:", "0,0,0:1,1,0.75"]) == pytest.approx(1 - 0.25 * 0.25)
    assert volume(wedge="z:0:90") == pytest.approx(3 / 4)
    assert volume(cutter="shape:cube") < 1


def test_cuts_may_be_for_some_parts():
    scene = cutaway.Scene()
    for number in range(3):
        scene.add(f"box {number}", *box(at=(0, 2 * number, 0)))
    scene.cut("x=50%", applies_to="box 1")
    scene.cut("z=50%", exclude=["box 0", "box 1"])
    parts = scene.capped().parts
    assert [round(parts[name].volume, 6) for name in scene.parts] == [1.0, 0.5, 0.5]


def test_names_of_parts_and_cuts(scene):
    assert scene.parts == ["cube"]
    assert scene.cuts == ["front"]
    assert repr(scene) == "Scene(parts=['cube'], cuts=['front'])"
    assert repr(cutaway.Scene()) == "Scene(parts=[], cuts=[])"


def test_missing_files_are_named(tmp_path):
    missing = tmp_path / "bracket.stl"
    for call in (cutaway.Scene.open, cutaway.Scene().add, cutaway.Scene):
        with pytest.raises(FileNotFoundError, match="bracket.stl(.|\n)*help:"):
            call(missing)
    with pytest.raises(FileNotFoundError, match="scene.toml"):
        cutaway.Scene.open(tmp_path / "scene.toml")
    (tmp_path / "scene.toml").write_text('[[part]]\nmesh = "gone.stl"\n')
    with pytest.raises((FileNotFoundError, ValueError), match="gone.stl"):
        cutaway.Scene.open(tmp_path / "scene.toml")


def test_files_that_are_no_meshes_are_named_with_their_lines(tmp_path):
    broken = tmp_path / "broken.obj"
    broken.write_text("v 0 0 0\nv 1 0 x\n")
    with pytest.raises(ValueError, match=r"broken.obj:2(.|\n)*help:"):
        cutaway.Scene(broken)
    (tmp_path / "scene.toml").write_text("[[part]]\nshape = \n")
    with pytest.raises(ValueError, match="scene.toml:2"):
        cutaway.Scene.open(tmp_path / "scene.toml")
    with pytest.raises(ValueError, match="help:"):
        cutaway.Scene(tmp_path)
    with pytest.raises(ValueError, match="help:"):
        cutaway.Scene("shape:cub")


def test_what_is_saved_shows_the_same(scene, tmp_path):
    scene.set("camera.azimuth_deg", 50)
    file = tmp_path / "scene.toml"
    scene.save(file)
    assert sorted(os.listdir(tmp_path)) == ["scene.1.ply", "scene.toml"]
    again = cutaway.Scene.open(file)
    assert again.parts == scene.parts
    assert again.section("x=30%").area == scene.section("x=30%").area
    first, second = scene.render(size=(64, 48)), again.render(size=(64, 48))
    assert np.array_equal(first, second)
    again.add("more", *box(at=(2, 0, 0)))
    again.save(tmp_path / "more.toml")
    assert cutaway.Scene.open(tmp_path / "more.toml").parts == ["cube", "more"]


def test_no_file_is_lost(scene, tmp_path):
    file = tmp_path / "scene.toml"
    scene.save(file)
    scene.save(file)  # The same may be written again.
    before = file.read_bytes()
    scene.cut("y=50%")
    with pytest.raises(FileExistsError, match="help:"):
        scene.save(file)
    assert file.read_bytes() == before
    scene.save(file, overwrite=True)
    assert file.read_bytes() != before
    with pytest.raises(FileNotFoundError, match="no such folder"):
        scene.save(tmp_path / "no" / "scene.toml")
    with pytest.raises(ValueError, match="ends in .toml"):
        scene.save(tmp_path / "scene.png")


def test_a_mesh_saved_before_keeps_its_file(tmp_path):
    """The third array of a scene once took the file of the second, which another part still named."""
    scene = cutaway.Scene()
    for name in ("a", "b"):
        scene.add(name, *box())
    file = tmp_path / "s.toml"
    scene.save(file)
    again = cutaway.Scene.open(file)
    again.remove("part.0")
    vertices, faces = box()
    again.add("c", np.asarray(vertices) + 1.0, faces)
    again.save(file, overwrite=True)
    last = cutaway.Scene.open(file)
    assert last.parts == ["b", "c"]
    assert last.get("part.0.mesh") != last.get("part.1.mesh")


def test_scenes_are_used_from_several_threads(scene):
    failures = []

    def work(number):
        try:
            for turn in range(5):
                scene.set("camera.azimuth_deg", 10 * number + turn)
                scene.section("z=50%")
                scene.capped()
                scene.render(size=(32, 24), supersample=1)
        except BaseException as error:  # noqa: BLE001
            failures.append(error)

    threads = [threading.Thread(target=work, args=(n,)) for n in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
        assert not thread.is_alive(), "it waits for ever"
    assert not failures, failures


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_goes_its_own_way(scene, copied):
    picture = scene.render(size=(32, 24)).rgba
    other = copied(scene)
    assert np.array_equal(other.render(size=(32, 24)).rgba, picture)
    other.set("cut.front.surfaces.0.section", "x=20%")
    other.add("second", *box(at=(2, 0, 0)))
    assert scene.get("cut.front.surfaces.0.section") == "x=50%" and scene.parts == ["cube"]
    scene.add("third", *box(at=(0, 2, 0)))
    assert other.parts == ["cube", "second"]
    assert np.any(other.render(size=(32, 24)).rgba != picture)


def test_a_pickled_scene_is_the_same_wherever_it_is_unpickled(scene, tmp_path, monkeypatch):
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir(), there.mkdir()
    (here / "a.obj").write_text("v 2 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    monkeypatch.chdir(here)
    scene.add("a.obj")
    picture = scene.render(size=(32, 24)).rgba
    scene.save("kept.toml")
    saved = cutaway.Scene.open("kept.toml")
    data = [pickle.dumps(s) for s in (scene, saved)]
    monkeypatch.chdir(there)
    for pickled in data:
        again = pickle.loads(pickled)
        assert again.parts == ["cube", "a"] and again.cuts == ["front"]
        assert np.array_equal(again.render(size=(32, 24)).rgba, picture)
        again.add("more", *box(at=(5, 0, 0)))
        assert again.parts[-1] == "more"
    assert pickle.loads(pickle.dumps(cutaway.Scene())).parts == []
    (here / "a.obj").unlink()
    with pytest.raises(FileNotFoundError, match="a.obj"):
        pickle.loads(data[0])


def test_an_empty_scene_says_what_is_missing():
    for call in (cutaway.Scene().render, cutaway.Scene().capped, cutaway.Scene().compare, lambda: cutaway.Scene().section("z=1")):
        with pytest.raises(ValueError, match="it has no parts(.|\n)*help:"):
            call()


def test_the_window_is_opened_if_it_is_there(scene, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FileNotFoundError, match="cargo install"):
        cutaway.show(scene)
    program = tmp_path / "cutaway-viewer"
    program.write_text(f'#!/bin/sh\n/bin/cp "$2" "{tmp_path}/seen.toml"\n')
    program.chmod(0o755)
    cutaway.show(scene, wait=True)
    assert 'name = "cube"' in (tmp_path / "seen.toml").read_text()
    cutaway.show("shape:cube", wait=True)
    assert "cube" in (tmp_path / "seen.toml").read_text()
