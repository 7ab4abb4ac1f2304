"""Uses the page in a real browser, and compares its pictures with those of the command.

    scripts/check_web.py PAGE PROGRAM OUT

PAGE is the folder that `make web` makes, PROGRAM the command, OUT a folder for screenshots and pictures.
"""

import base64
import functools
import http.server
import json
import os
import subprocess
import sys
import threading

from chromium import Page

SIZE_PX = (1100, 700)
# So many pixels of 340,000 may be seen otherwise by another driver.
FEW_PX = 5
# A browser that has no WebGPU.
WITHOUT = ["--headless=new", "--no-sandbox", "--no-first-run", "--disable-gpu", "--disable-features=WebGPU", "--remote-debugging-pipe"]

page_folder, program, out = (os.path.realpath(argument) for argument in sys.argv[1:4])


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

    def log_message(self, *_):
        pass


def serve():
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=page_folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/index.html"


def box(corner, size, inward):
    """Facets of a box as text of an STL; its normals point outward, or inward for a cavity."""
    a, b = corner, [c + s for c, s in zip(corner, size)]
    facets = []
    for axis in range(3):
        for high in (False, True):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            def at(s, t):
                point = [0.0, 0.0, 0.0]
                point[axis] = (b if high else a)[axis]
                point[u] = (b if s else a)[u]
                point[v] = (b if t else a)[v]
                return point
            square = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)]
            if high == inward:
                square.reverse()
            facets += [[square[0], square[1], square[2]], [square[0], square[2], square[3]]]
    return facets


def write_model(path):
    """A hollow box as text, the first bytes of which are no number of facets that fits."""
    facets = box([0, 0, 0], [3, 2, 1], False) + box([0.5, 0.4, 0.3], [2, 1.2, 0.4], True)
    with open(path, "w") as file:
        file.write("solid hollow box, written as text for this check\n")
        for facet in facets:
            file.write("facet normal 0 0 0\nouter loop\n")
            for point in facet:
                file.write("vertex %g %g %g\n" % tuple(point))
            file.write("endloop\nendfacet\n")
        file.write("endsolid\n")


def expect(is_so, what):
    print(("ok: " if is_so else "FAILED: ") + what)
    if not is_so:
        raise SystemExit(1)


def settle(page):
    page.wait("!cutaway.is_busy()", 240, "the picture")


def pixels(page, side):
    code = f"cutaway.picture({'true' if side == 'B' else 'false'}).then((p) => {{ let s = ''; for (const b of p) s += String.fromCharCode(b); return btoa(s); }})"
    return base64.b64decode(page.run(code))


def drawn(scene, strategy, size_px):
    """The same scene by the command."""
    path = os.path.join(out, "scene.toml")
    with open(path, "w") as file:
        file.write(scene)
    size = "{},{}".format(*size_px)
    image = os.path.join(out, "native.png")
    command = [program, "render", path, "--strategy", strategy, "--resolution", size, "--supersample", "1", "--quiet", "-o", image]
    subprocess.run(command, check=True)
    return subprocess.run(["convert", image, "-depth", "8", "rgba:-"], check=True, capture_output=True).stdout


def differing(a, b):
    """How many pixels differ, and how many by more than one level and more than 16 levels."""
    if len(a) != len(b):
        return [len(a)] * 3
    most = [max(abs(x - y) for x, y in zip(a[i:i + 4], b[i:i + 4])) for i in range(0, len(a), 4) if a[i:i + 4] != b[i:i + 4]]
    return [sum(m > least for m in most) for least in (0, 1, 16)]


def choose(page, side, name):
    page.run(f"cutaway.choose({'true' if side == 'B' else 'false'}, {json.dumps(name)})")


def use(address):
    model = os.path.join(out, "hollow.stl")
    write_model(model)
    page = Page(address, SIZE_PX)
    try:
        seconds = page.wait("globalThis.cutaway", 120, "the start")
        print(f"started after {seconds:.1f} s")
        expect("[[part]]" not in page.run("cutaway.scene()"), "it begins empty")
        # One sample a pixel, as it is compared.
        page.run("cutaway.smooth(false)")
        page.drop([model], 500, 300)
        page.wait("cutaway.scene().includes('hollow.stl')", 60, "the model that was dropped")
        settle(page)
        # The button *Plane* stands first in the list of cuts.
        page.click(36, 60)
        page.wait("cutaway.scene().includes('section')", 30, "the plane of the button")
        settle(page)
        before = page.run("cutaway.scene()")
        expect("50%" in before, "the plane goes through the middle")
        # The arrow begins in the middle of the section, and points to the eye: to the left and down.
        left, top = 220, 24
        width, height = page.run("Array.from(cutaway.size_px())")
        middle = (left + width / 2, top + height / 2)
        page.drag((middle[0] - 30, middle[1] + 16), (middle[0] - 80, middle[1] + 44))
        settle(page)
        after = page.run("cutaway.scene()")
        cut = [line for line in after.splitlines() if "section" in line]
        expect("50%" not in cut[0], f"the arrow was dragged: {cut[0]}")
        page.key("w", 87)
        slots = [("A", "raycast+mask@compute"), ("B", "raycast+abuffer@compute")]
        for side, name in slots:
            choose(page, side, name)
        settle(page)
        # Both drivers find the same layers but for a few; the style rounds its light by one level here and there.
        for side, name in slots:
            expect(page.run(f"cutaway.refusal({'true' if side == 'B' else 'false'})") is None, f"{name} draws it")
            count, more, _ = differing(pixels(page, side), drawn(after, name, (width, height)))
            expect(more <= FEW_PX, f"{name}: {count} px differ from the command's, {more} of them by more than one level")
        count, _, _ = differing(pixels(page, "A"), drawn(before, "raycast+mask@compute", (width, height)))
        expect(count > 1000, f"control: {count} px differ from the picture before the drag")
        choose(page, "B", "raycast+mask")
        settle(page)
        count, _, much = differing(pixels(page, "B"), drawn(after, "raycast+mask", (width, height)))
        expect(much <= 200, f"raycast+mask: {count} px differ from the command's, {much} by more than 16 levels: another rasteriser")
        choose(page, "B", "grid:16+vds:64")
        page.run("cutaway.show_errors(true)")
        page.wait("cutaway.errors(false) && cutaway.errors(true) && !cutaway.is_busy()", 300, "the errors")
        a, b = (json.loads(page.run(f"cutaway.errors({which})")) for which in ("false", "true"))
        expect(a["decided_wrong_px"] == 0, "the worker finds no pixel of raycast+mask@compute wrong")
        expect(b["decided_wrong_px"] > 0, f"and {b['decided_wrong_px']} px of grid:16+vds:64")
        page.click(left + width / 4, top + height / 2)
        page.wait("cutaway.crossings() && !cutaway.is_busy()", 60, "a magnified pixel")
        crossings = json.loads(page.run("cutaway.crossings()"))
        expect(sum(c["is_seen"] for c in crossings) == 1, f"its ray crosses {len(crossings)} surfaces, of which one is seen")
        page.screenshot(os.path.join(out, "magnified.png"))
        choose(page, "A", "exact")
        settle(page)
        count, more, _ = differing(pixels(page, "A"), drawn(after, "exact", (width, height)))
        expect(more == 0, f"exact: {count} px differ from the command's, {more} of them by more than one level")
        why = page.run("(() => { try { return cutaway.fragment() } catch (why) { return String(why) } })()")
        expect("hollow.stl" in why, "there is no link to a scene with files, and it says so")
        page.screenshot(os.path.join(out, "page.png"))
        expect(not page.console, f"the browser complains of nothing: {page.console[:3]}")
    finally:
        page.close()


def follow_link(address):
    page = Page(address, SIZE_PX)
    try:
        page.wait("globalThis.cutaway", 120, "the start")
        page.run("cutaway.smooth(false)")
        # A style without occlusion, by the rasteriser that is the same everywhere.
        scene = 'style = "lit"\n\n[[part]]\nshape = "torus?segments=48&sides=24"\n\n[[cut]]\nsurfaces = [{ section = "-z=40%" }]\n'
        page.run(f"cutaway.take('scene.toml', new TextEncoder().encode({json.dumps(scene)}))")
        page.wait("cutaway.scene().includes('torus')", 60, "the scene")
        choose(page, "A", "raycast+mask@compute")
        settle(page)
        fragment, seen = page.run("cutaway.fragment()"), pixels(page, "A")
        size_px = page.run("Array.from(cutaway.size_px())")
        count, _, _ = differing(seen, drawn(page.run("cutaway.scene()"), "raycast+mask@compute", size_px))
        # Vertices are moved in single precision, which drivers round each in their way: at a silhouette that is a pixel.
        expect(count <= FEW_PX, f"raycast+mask@compute in the style lit: {count} px differ from the command's")
        print(f"the link has {len(fragment)} characters")
    finally:
        page.close()
    page = Page(f"{address}#{fragment}", SIZE_PX)
    try:
        page.wait("globalThis.cutaway", 120, "the start by a link")
        page.run("cutaway.smooth(false)")
        settle(page)
        expect(differing(pixels(page, "A"), seen)[0] == 0, "a link shows the same picture, bit for bit")
    finally:
        page.close()


def without_webgpu(address):
    page = Page(address, SIZE_PX, WITHOUT)
    try:
        page.wait("document.getElementById('sentence')?.textContent.includes('WebGPU')", 60, "the sentence")
        expect(page.run("document.querySelector('img').naturalWidth") > 0, "without WebGPU there is a picture and a sentence")
    finally:
        page.close()


def lose_device(address):
    """Changes are asked about before the page is left, and a device that the browser takes away leaves the scene in the address."""
    page = Page(address, SIZE_PX)
    try:
        keeps = "const asked = GPUAdapter.prototype.requestDevice; GPUAdapter.prototype.requestDevice = async function (...all) { return globalThis.device = await asked.apply(this, all); };"
        page.call("Page.addScriptToEvaluateOnNewDocument", {"source": keeps})
        page.call("Page.navigate", {"url": address})
        page.wait("!!globalThis.cutaway && !!globalThis.device", 120, "the start")
        asks = "!dispatchEvent(new Event('beforeunload', { cancelable: true }))"
        scene = '[[part]]\nshape = "cube"\n'
        page.run(f"cutaway.take('scene.toml', new TextEncoder().encode({json.dumps(scene)}))")
        page.wait("cutaway.scene().includes('cube')", 60, "the scene")
        settle(page)
        expect(not page.run(asks), "a page without changes is left at once")
        page.click(36, 60)
        page.wait("cutaway.scene().includes('section')", 30, "the plane of the button")
        settle(page)
        expect(page.run(asks), "one with changes is asked about")
        page.run("device.destroy()")
        page.wait("document.getElementById('sentence')?.textContent.includes('Reload the page: the link')", 60, "the sentence")
        page.screenshot(os.path.join(out, "lost.png"))
        expect(not page.run(asks), "without a device the page is left at once")
        page.call("Page.reload")
        page.wait("!!globalThis.cutaway?.scene().includes('section')", 120, "the scene of the address")
        expect(True, "a lost device leaves the scene in the address")
    finally:
        page.close()


os.makedirs(out, exist_ok=True)
address = serve()
without_webgpu(address)
follow_link(address)
lose_device(address)
use(address)
