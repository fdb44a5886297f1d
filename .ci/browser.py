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

FLAGS = [
    "--headless",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
    "--disable-extensions",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--no-first-run",
    "--remote-debugging-port=0",
]


class Browser:
    """A tab, with the `errors` and `requests` of its pages."""

    def __init__(self, *flags):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = pathlib.Path(self.profile.name)
        command = ["chromium", *FLAGS, *flags, f"--user-data-dir={folder}", "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port = self._wait_for(lambda: self._port(folder / "DevToolsActivePort"), "no browser")
        self.socket = websocket.create_connection(f"ws://127.0.0.1:{port[0]}{port[1]}", suppress_origin=True, timeout=120)
        self.sent, self.session = 0, None
        self.errors, self.requests, self.loaded = [], [], False
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self.send(f"{domain}.enable")

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait(20)
        self.profile.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    @staticmethod
    def _port(path):
        lines = path.read_text().split() if path.exists() else []
        return lines if len(lines) == 2 else None

    @staticmethod
    def _wait_for(found, otherwise, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := found():
                return value
            time.sleep(0.05)
        raise TimeoutError(otherwise)

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

    def show(self, width, height, dark=False, scale=1, touch=False):
        """Sets the size of the window and the preferences of the user."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
        self.send("Emulation.setTouchEmulationEnabled", enabled=touch)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.send("Emulation.setEmulatedMedia", features=[scheme])

    def open(self, path):
        """Opens a file, and returns the seconds until its first picture."""
        begun = time.monotonic()
        self.loaded = False
        self.send("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        while not self.loaded:
            self._record(json.loads(self.socket.recv()))
        self.settle()
        return time.monotonic() - begun

    def settle(self):
        """Waits until changes are drawn."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def run(self, script):
        """Returns the JSON value of a script, after waiting for promises."""
        response = self.send("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in response:
            raise RuntimeError(f"{script}: {response['exceptionDetails']}")
        return response["result"].get("value")

    def click(self, x, y):
        for kind in ["mousePressed", "mouseReleased"]:
            self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
        self.settle()

    def drag(self, start, end):
        at = {"button": "left", "buttons": 1, "clickCount": 1}
        self.send("Input.dispatchMouseEvent", type="mousePressed", x=start[0], y=start[1], **at)
        for part in [0.25, 0.5, 0.75, 1.0]:
            x, y = (a + part * (b - a) for a, b in zip(start, end))
            self.send("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y, **at)
        self.send("Input.dispatchMouseEvent", type="mouseReleased", x=end[0], y=end[1], **at)
        self.settle()

    def touch(self, *steps):
        """Moves fingers: a list of points for each step, from the first touch to the last."""
        for n, points in enumerate(steps):
            fingers = [{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(points)]
            self.send("Input.dispatchTouchEvent", type="touchMove" if n else "touchStart", touchPoints=fingers)
        self.send("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.settle()

    def press(self, key, shift=False):
        text = key if len(key) == 1 else "\r" if key == "Enter" else ""
        about = {"key": key, "modifiers": 8 if shift else 0}
        self.send("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", text=text, **about)
        self.send("Input.dispatchKeyEvent", type="keyUp", **about)
        self.settle()

    def picture(self, path=None, whole=False):
        """Returns a screenshot, and writes it to a file if a path is given."""
        shot = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        image = Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")
        if path:
            image.save(path)
        return image
