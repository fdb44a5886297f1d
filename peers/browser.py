"""A headless browser, controlled over the DevTools protocol: chromium and python3-websocket of Debian."""

import base64
import io
import json
import pathlib
import subprocess
import tempfile
import time

import websocket
from PIL import Image

FLAGS = """--headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars --disable-extensions
--disable-dev-shm-usage --disable-background-networking --no-first-run --remote-debugging-port=0""".split()


class Browser:
    """A tab, with the `errors` and `requests` of its pages."""

    def __init__(self, *flags):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = pathlib.Path(self.profile.name)
        command = ["chromium", *FLAGS, *flags, f"--user-data-dir={folder}", "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        file, port, end = folder / "DevToolsActivePort", [], time.monotonic() + 60
        while len(port) < 2:
            if time.monotonic() > end:
                raise TimeoutError("no browser")
            time.sleep(0.05)
            port = file.read_text().split() if file.exists() else []
        self.socket = websocket.create_connection(f"ws://127.0.0.1:{port[0]}{port[1]}", suppress_origin=True, timeout=120)
        self.sent, self.session = 0, None
        self.errors, self.requests, self.loaded = [], [], False
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self.send(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()
        self.process.terminate()
        self.process.wait(20)
        self.profile.cleanup()

    def send(self, method, **parameters):
        """Sends a command and returns the response. Events that arrive meanwhile are recorded."""
        self.sent += 1
        message = {"id": self.sent, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        self.socket.send(json.dumps(message))
        while True:
            response = json.loads(self.socket.recv())
            if response.get("id") == self.sent:
                if "error" in response:
                    raise RuntimeError(f"{method}: {response['error']}")
                return response["result"]
            self._record(response)

    def _record(self, event):
        values = event.get("params", {})
        match event.get("method"):
            case "Runtime.exceptionThrown":
                details = values["exceptionDetails"]
                self.errors.append(details.get("exception", {}).get("description", details["text"]))
            case "Runtime.consoleAPICalled" if values["type"] in ("error", "warning", "assert"):
                self.errors.append(" ".join(str(part.get("value")) for part in values["args"]))
            case "Log.entryAdded" if values["entry"]["level"] in ("error", "warning"):
                self.errors.append(values["entry"]["text"])
            case "Network.requestWillBeSent":
                self.requests.append(values["request"]["url"])
            case "Page.loadEventFired":
                self.loaded = True

    def open(self, path, size=(1280, 860), touch=False):
        """Opens a file in a window of this size."""
        width, height = size
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=touch)
        self.send("Emulation.setTouchEmulationEnabled", enabled=touch)
        self.errors.clear()
        self.requests.clear()
        self.loaded = False
        self.send("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        while not self.loaded:
            self._record(json.loads(self.socket.recv()))
        self.run("0")

    def run(self, script):
        """Returns the JSON value of a script, after the page has drawn the changes."""
        drawn = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        for each in (script, drawn):
            response = self.send("Runtime.evaluate", expression=each, awaitPromise=True, returnByValue=True)
            if "exceptionDetails" in response:
                raise RuntimeError(f"{each}: {response['exceptionDetails']}")
            if each is script:
                value = response["result"].get("value")
        return value

    def click(self, x, y):
        for kind in ["mousePressed", "mouseReleased"]:
            self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
        self.run("0")

    def touch(self, *steps):
        """Moves fingers: a list of points for each step, from the first touch to the last."""
        for n, points in enumerate(steps):
            fingers = [{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(points)]
            self.send("Input.dispatchTouchEvent", type="touchMove" if n else "touchStart", touchPoints=fingers)
        self.send("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.run("0")

    def press(self, key, shift=False):
        text = key if len(key) == 1 else "\r" if key == "Enter" else ""
        about = {"key": key, "modifiers": 8 if shift else 0}
        self.send("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", text=text, **about)
        self.send("Input.dispatchKeyEvent", type="keyUp", **about)
        self.run("0")

    def picture(self):
        shot = self.send("Page.captureScreenshot", format="png")
        return Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")
