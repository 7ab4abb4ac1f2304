"""A headless Chromium that is driven by its own protocol, over a pipe: no driver and no package is needed."""

import base64
import fcntl
import json
import os
import subprocess
import tempfile
import time

# A software adapter by SwiftShader, as machines without a graphics card have it.
OPTIONS = [
    "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--hide-scrollbars", "--no-first-run",
    "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader",
    "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--enable-gpu", "--remote-debugging-pipe",
]


class Page:
    """A page in a browser of its own."""

    def __init__(self, address, size_px, options=OPTIONS):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        theirs_in, self.to = os.pipe()
        self.answers, theirs_out = os.pipe()
        width, height = size_px
        command = ["chromium", *options, f"--user-data-dir={self.folder.name}", f"--window-size={width},{height + 160}", "about:blank"]

        def place():
            # The protocol is spoken over 3 and 4, which these may be themselves.
            aside = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (theirs_in, theirs_out)]
            os.dup2(aside[0], 3)
            os.dup2(aside[1], 4)

        self.process = subprocess.Popen(
            command, preexec_fn=place, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in)
        os.close(theirs_out)
        self.buffer = b""
        self.count = 0
        self.console = []
        targets = self.call("Target.getTargets", session=None)["targetInfos"]
        target = next(t["targetId"] for t in targets if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", {"targetId": target, "flatten": True}, session=None)["sessionId"]
        self.call("Runtime.enable")
        self.call("Log.enable")
        self.call("Page.enable")
        self.call("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        self.call("Page.navigate", {"url": address})

    def call(self, method, params=None, session=""):
        self.count += 1
        message = {"id": self.count, "method": method, "params": params or {}}
        if session is not None:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        number = self.count
        while True:
            answer = self.next()
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.note(answer)

    def next(self):
        while b"\0" not in self.buffer:
            got = os.read(self.answers, 1 << 20)
            if not got:
                raise RuntimeError("the browser ended")
            self.buffer += got
        line, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(line)

    def note(self, event):
        params = event.get("params", {})
        if event.get("method") == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            self.console.append(" ".join(str(a.get("value", a.get("description"))) for a in params["args"]))
        elif event.get("method") == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.console.append(details.get("exception", {}).get("description", details["text"]))
        elif event.get("method") == "Log.entryAdded" and params["entry"]["level"] == "error":
            self.console.append(params["entry"]["text"])

    def run(self, code):
        """The value of an expression, awaited."""
        answer = self.call("Runtime.evaluate", {"expression": code, "awaitPromise": True, "returnByValue": True})
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise RuntimeError(f"{code[:80]}: {details.get('exception', {}).get('description') or details['exception'].get('value')}")
        return answer["result"].get("value")

    def wait(self, code, seconds, what):
        """Until an expression holds."""
        began = time.monotonic()
        while not self.run(code):
            if time.monotonic() - began > seconds:
                raise RuntimeError(f"{what}: not within {seconds} s; the browser says: {self.console[-5:]}")
            time.sleep(0.1)
        return time.monotonic() - began

    def mouse(self, kind, x, y, buttons=0):
        held = {"button": "left", "buttons": buttons, "clickCount": 1} if kind != "mouseMoved" else {"buttons": buttons, "button": "left" if buttons else "none"}
        self.call("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, **held})

    def drag(self, start, end, steps=8):
        """Presses at a point, moves to another and lets go."""
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, buttons=1)
        for step in range(1, steps + 1):
            share = step / steps
            self.mouse("mouseMoved", *[a + (b - a) * share for a, b in zip(start, end)], buttons=1)
            time.sleep(0.05)
        self.mouse("mouseReleased", *end)

    def click(self, x, y):
        self.drag((x, y), (x, y), steps=1)

    def drop(self, files, x, y):
        """Drops files, as from a file manager."""
        data = {"items": [], "files": files, "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.call("Input.dispatchDragEvent", {"type": kind, "x": x, "y": y, "data": data})

    def key(self, key, code):
        for kind in ("keyDown", "keyUp"):
            text = {"text": key} if kind == "keyDown" else {}
            self.call("Input.dispatchKeyEvent", {"type": kind, "key": key, "code": f"Key{key.upper()}", "windowsVirtualKeyCode": code, **text})

    def screenshot(self, path):
        png = self.call("Page.captureScreenshot", {"format": "png"})["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(png))

    def close(self):
        self.process.kill()
        self.process.wait()
        self.folder.cleanup()
