#!/usr/bin/env python3
"""Tries the page in headless Chromium, and compares it with the desktop's program.
Usage: page.py PAGE DESKTOP
PAGE: the folder of the page. DESKTOP: the folder with what the desktop's program writes:
see tests/checks.sh."""
import base64, functools, http.server, io, json, os, subprocess, sys, threading, time, urllib.request
from PIL import Image, ImageChops, ImageStat

page, desktop = sys.argv[1:]
size = {"width": 1280, "height": 720}
patience = 120  # s, for whatever takes long on a busy machine


def fail(text):
    sys.exit("page: " + text)


def serve(folder):
    """Serves the files of a folder, and returns the address."""
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_): pass
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/"


class Browser:
    """Chromium, by chromedriver's protocol (W3C WebDriver)."""

    def __init__(self):
        self.driver = subprocess.Popen(["chromedriver", "--port=9515", "--silent"])
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                            "--enable-unsafe-swiftshader", "--force-device-scale-factor=1"]}
        self.session = ""
        capabilities = {"alwaysMatch": {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"},
                                        "timeouts": {"script": 1000 * patience}}}
        for _ in range(patience):
            try:
                self.session = "/session/" + self.call("/session", {"capabilities": capabilities})["sessionId"]
                break
            except urllib.error.URLError:
                time.sleep(1)
        self.metrics(size["width"], size["height"], touch=False)

    def call(self, path, body=None):
        request = urllib.request.Request("http://127.0.0.1:9515" + self.session + path,
                                         None if body is None else json.dumps(body).encode())
        try:
            return json.load(urllib.request.urlopen(request, timeout=2 * patience))["value"]
        except urllib.error.HTTPError as error:
            fail(json.load(error)["value"]["message"])

    def metrics(self, width, height, touch):
        for command, params in (("Emulation.setDeviceMetricsOverride",
                                 {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}),
                                ("Emulation.setTouchEmulationEnabled", {"enabled": touch, "maxTouchPoints": 5})):
            self.call("/goog/cdp/execute", {"cmd": command, "params": params})

    def open(self, address):
        self.call("/url", {"url": address})

    def run(self, script, *arguments):
        return self.call("/execute/sync", {"script": script, "args": list(arguments)})

    def until(self, what, script, *arguments):
        """Waits until a script returns something, and returns that."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if (value := self.run(script, *arguments)) not in (None, False):
                return value
            time.sleep(0.1)
        fail(f"waited in vain: {what}; it says: {self.messages()}")

    def messages(self):
        return [entry["message"] for entry in self.call("/se/log", {"type": "browser"})]

    def keys(self, *keys):
        self.act({"type": "key", "id": "keys", "actions": [
            {"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]})

    def pointer(self, kind, *steps):
        """steps: (x, y) moves there, in 100 ms; True and False press and lift."""
        actions = []
        for step in steps:
            if isinstance(step, tuple):
                actions.append({"type": "pointerMove", "duration": 100, "x": step[0], "y": step[1]})
            else:
                actions.append({"type": "pointerDown" if step else "pointerUp", "button": 0})
        self.act({"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": actions})

    def act(self, source):
        self.call("/actions", {"actions": [source]})
        self.pictures(2)

    def pictures(self, count):
        """Waits until the browser has drawn so many."""
        self.call("/execute/async", {"args": [count], "script": """
            const [count, done] = arguments;
            const next = left => left ? requestAnimationFrame(() => next(left - 1)) : done(true);
            next(count);"""})

    def screenshot(self, name):
        picture = base64.b64decode(self.call("/screenshot"))
        with open(os.path.join(page, "..", name + ".png"), "wb") as file:
            file.write(picture)
        return Image.open(io.BytesIO(picture)).convert("RGB")

    def close(self):
        self.call("/window")
        self.driver.terminate()


def differing(a, b):
    """Returns the share of pixels in which some channel differs by more than 32, as tests/app/pictures_test.cpp."""
    largest = functools.reduce(ImageChops.lighter, ImageChops.difference(a, b).split())
    return sum(largest.histogram()[33:]) / (a.width * a.height)


# Keeps what the program prints and hands over as a download.
hook = """
window.printed = []; window.saved = []; let module;
Object.defineProperty(window, 'Module', {get: () => module, set: value => {
  if (module) return;
  const print = value.print;
  value.print = line => { printed.push(line); print(line); };
  value.download = path => saved.push(path);
  module = value;
}});"""


def command(browser, *words):
    """Runs a command in the page and returns what it prints."""
    return "\n".join(browser.run("printed.length = 0; callMain(arguments[0]); return printed;", list(words)))


def facts(document):
    """Returns a document without what depends on the clock."""
    if isinstance(document, dict):
        return {key: facts(value) for key, value in document.items() if key not in ("ms", "threads")}
    return [facts(value) for value in document] if isinstance(document, list) else document


def same_facts(name, printed):
    with open(os.path.join(desktop, name)) as file:
        theirs = facts(json.load(file))
    ours = facts(json.loads(printed))
    for key in theirs:
        if ours[key] != theirs[key]:
            fail(f"{name}: {key} differs from the desktop's")


def start(browser, address):
    browser.open(address)
    browser.until("the page shows the program", "return document.querySelector('#cover').hidden && window.Module?.calledRun")
    browser.pictures(5)


def moves(browser, name, before, least=0.001):
    """Fails unless the picture differs from that before. Returns it."""
    after = browser.screenshot(name)
    if (share := differing(before, after)) < least:
        fail(f"{name}: only {share:.5f} of the pixels have changed")
    return after


def commands(browser):
    """State, contacts and misses are the desktop's, to the bit."""
    words = ("--scene=drop", "--frames=300")
    same_facts("simulate.json", command(browser, "simulate", *words, "--oracle", "--json"))
    command(browser, "simulate", *words, "--obj-every=300", "--out=/made")
    same_facts("detect.json", command(browser, "detect", "--method=all", "--json", "/made/frame_0300.obj"))


def frames(browser):
    """Takes 300 steps in the window, each by a key. Of three frames the picture is most like the right one."""
    browser.keys(" ")
    browser.keys("r")
    browser.keys("x")
    for _ in range(300):
        browser.keys("n")
    shown = browser.screenshot("frame_0300")
    shares = {}
    for frame in (290, 300, 310):
        theirs = Image.open(os.path.join(desktop, f"frame_{frame:04}.png")).convert("RGB")
        shares[frame] = differing(shown, theirs)
    print("differing pixels: " + ", ".join(f"frame {frame} {share:.4f}" for frame, share in shares.items()))
    if min(shares, key=shares.get) != 300 or shares[300] > 0.02:
        fail("the picture of frame 300 is not the desktop's")
    browser.keys("p")
    browser.until("a picture is saved", "return saved.length")
    picture = bytes(browser.run("return Array.from(FS.readFile(saved[0]))"))
    if Image.open(io.BytesIO(picture)).size != (size["width"], size["height"]):
        fail("the saved picture has another size")


def inputs(browser):
    """The page takes a key, a click, a touch and a dropped file."""
    browser.keys("x")
    before = browser.screenshot("panel")
    browser.keys("v")
    before = moves(browser, "key", before)
    browser.pointer("mouse", (800, 500), (800, 420), True, False, (20, 20))
    before = moves(browser, "click", before, 0.0002)
    browser.metrics(390, 844, touch=True)
    browser.pictures(5)
    before = browser.screenshot("telephone")
    browser.pointer("touch", (200, 300), True, (230, 300), (300, 320), False)
    before = moves(browser, "touch", before)
    with open(os.path.join(os.path.dirname(__file__), "../../assets/meshes/star.obj")) as file:
        browser.run("""
            const files = new DataTransfer();
            files.items.add(new File([arguments[0]], 'star.obj'));
            document.querySelector('#canvas').dispatchEvent(new DragEvent('drop', {dataTransfer: files}));""", file.read())
    browser.until("the file is there", "return FS.analyzePath('/.glfw_dropped_files/star.obj').exists")
    browser.pictures(10)
    moves(browser, "dropped", before)


address = serve(page)
browser = Browser()
try:
    browser.call("/goog/cdp/execute", {"cmd": "Page.addScriptToEvaluateOnNewDocument", "params": {"source": hook}})
    start(browser, address + "?scene=drop")
    frames(browser)
    inputs(browser)
    commands(browser)
    browser.open(address + "?scene=nothing")
    browser.until("it says what is wrong", "return document.querySelector('#text').textContent.includes('nothing')")
finally:
    browser.close()
print("page: all is well")
