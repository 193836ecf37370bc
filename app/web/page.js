// The page around the program: loads it, gives it arguments, files, clipboard and downloads, and turns touches into the
// mouse events that the program knows.

const element = id => document.getElementById(id);
const canvas = element('canvas'), cover = element('cover'), bar = cover.querySelector('progress');
const preferences = '/preferences.toml', stored = 'sbcollide' + preferences;
let printed = '';

/// Shows a text in place of the program.
function refuse(text) {
  element('text').textContent = text;
  cover.hidden = false;
  bar.remove();
  element('bar')?.remove();
  const [plain, all] = cover.querySelectorAll('a');
  plain.hidden = all.hidden = !location.search;
  plain.href = location.pathname;
}

const place = element('scene');  // of the canvas

/// Returns the words of the command line: ?scene=D&self is --scene=D --self.
function words() {
  const given = location.search.slice(1).split('&').filter(part => part).map(part => '--' + decodeURIComponent(part));
  return [`--size=${place.clientWidth}x${place.clientHeight}`, '--threads=1', ...given];
}

// Where storage is forbidden, nothing is remembered.
function keepPreferences() {
  try { localStorage.setItem(stored, FS.readFile(preferences, {encoding: 'utf8'})); } catch {}
}
function restorePreferences() {
  try { if (localStorage.getItem(stored)) FS.writeFile(preferences, localStorage.getItem(stored)); } catch {}
}

/// Makes the canvas as large as its place, in pixels of the screen.
function resize() {
  Module.setCanvasSize(place.clientWidth, place.clientHeight);
}

globalThis.Module = {
  canvas,
  print: line => printed += line + '\n',
  printErr: line => {
    console.error(line);
    const [, why] = line.match(/(?:^|\r)sbcollide: (.*)$/) ?? [];  // a line of progress may stand before it
    // An address writes options without dashes, and a link leads to their list.
    if (why) refuse(why.replace(/;? [Ss]ee sbcollide (\w+ )?--help/, '').replace(/--(?=[a-z])/g, ''));
  },
  preRun: [restorePreferences],
  postRun: [() => {
    element('text').classList.toggle('printed', printed);
    if (printed) refuse(printed);
    if (!bar.isConnected) return;
    new ResizeObserver(resize).observe(place);
    setInterval(keepPreferences, 1000);
    cover.hidden = true;
  }],
  copyText: text => {
    const byHand = () => prompt('Copy this:', text);
    navigator.clipboard ? navigator.clipboard.writeText(text).catch(byHand) : byHand();
  },
  download: path => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
    link.download = path.split('/').pop();
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  },
  chooseFiles: () => element('files').click(),
};
window.addEventListener('error', ({error, message}) => {
  if (error instanceof WebAssembly.RuntimeError) refuse(`The program has stopped: ${message}. Reload the page.`);
});

// WebGL has the renderer's name, by which the program knows a slow one, in an extension.
const parameter = globalThis.WebGL2RenderingContext?.prototype.getParameter;
if (parameter) WebGL2RenderingContext.prototype.getParameter = function(name) {
  const names = name === this.RENDERER && this.getExtension('WEBGL_debug_renderer_info');
  return parameter.call(this, names ? names.UNMASKED_RENDERER_WEBGL : name);
};

/// Returns a file's bytes. tell(part): how much of it has come.
async function fetchBytes(name, tell) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: the server answers ${answer.status}`);
  const size = Number(answer.headers.get('Content-Length')), reader = answer.body.getReader(), parts = [];
  let length = 0;
  for (let part; !(part = await reader.read()).done;) {
    parts.push(part.value);
    length += part.value.length;
    tell(size ? Math.min(length / size, 1) : 0);  // a packed file is longer than its size says
  }
  return new Blob(parts).arrayBuffer();
}

async function load() {
  if (!document.createElement('canvas').getContext('webgl2'))
    throw new Error('This page draws with WebGL 2, which is missing here: use a current browser, ' +
                    'and switch its hardware acceleration on.');
  Module.arguments = words();
  let wasmPart = 0, dataPart = 0;
  const show = () => bar.value = 0.75 * wasmPart + 0.25 * dataPart;
  const [wasm, data] = await Promise.all([
    fetchBytes('sbcollide.wasm', part => { wasmPart = part; show(); }),
    fetchBytes('sbcollide.data', part => { dataPart = part; show(); })]);
  Module.wasmBinary = wasm;
  Module.getPreloadedPackage = () => data;
  const script = document.createElement('script');
  script.src = 'sbcollide.js';
  document.body.append(script);
}

// Files that are chosen are dropped on the canvas.
element('files').addEventListener('change', event => {
  const dropped = new DataTransfer();
  for (const file of event.target.files) dropped.items.add(file);
  event.target.value = '';
  canvas.dispatchEvent(new DragEvent('drop', {dataTransfer: dropped}));
});

/// Types a character, as a keyboard does.
function type(character) {
  for (const kind of ['keydown', 'keypress', 'keyup']) {
    const event = new KeyboardEvent(kind, {key: character});
    Object.defineProperty(event, 'keyCode', {value: character.toUpperCase().charCodeAt(0)});
    Object.defineProperty(event, 'charCode', {value: character.charCodeAt(0)});
    window.dispatchEvent(event);
  }
}
for (const button of document.querySelectorAll('[data-key]'))
  button.addEventListener('click', () => type(button.dataset.key));
element('keyboard').addEventListener('click', () => element('typed').focus());
element('typed').addEventListener('input', event => {
  for (const character of event.target.value) type(character);
  event.target.value = '';
});
// Keys that the browser would act on, too; what is typed into the field comes by its input event.
for (const kind of ['keydown', 'keypress'])
  window.addEventListener(kind, event => {
    if (['F1', 'F11'].includes(event.key) || (event.ctrlKey && 'zZyY'.includes(event.key))) event.preventDefault();
    if (event.target === element('typed') && event.key.length === 1) event.stopImmediatePropagation();
  }, true);

function mouse(kind, at, button = 0) {
  canvas.dispatchEvent(new MouseEvent(kind, {clientX: at.x, clientY: at.y, button}));
}
function turnWheel(steps) {
  canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -100 * steps, bubbles: true, cancelable: true}));
}
for (const kind of ['contextmenu', 'webglcontextlost']) canvas.addEventListener(kind, event => event.preventDefault());
canvas.addEventListener('mouseenter', () => Module.hovered = true);
canvas.addEventListener('mouseleave', () => Module.hovered = false);
// A drag may end beside the canvas.
for (const kind of ['mousemove', 'mouseup'])
  window.addEventListener(kind, event => {
    if (event.target !== canvas) mouse(kind, {x: event.clientX, y: event.clientY}, event.button);
  });

// What fingers do. One that moves at once is the middle button, which orbits; over the interface it scrolls (up and
// down), or is the left button. One that rests before it moves is the left button, which drags a body. Two are the
// right button, which pans, and turn the wheel when they move apart. Times are of the events: the page may be late.
const left = 0, middle = 1, right = 2;
const slop = 8, scrollStep = 75, hold = 350, zoomStep = 0.9;  // CSS pixels; ms; of Camera::zoom()
let start = null, last, began, waits, scrolls, button;
const overInterface = at => Module._page_over_interface(at.x, at.y);
function middleOf(touches) {
  const [a, b = a] = touches;
  return {x: (a.clientX + b.clientX) / 2, y: (a.clientY + b.clientY) / 2,
          width: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY)};
}
function press(which) {
  button = which;
  mouse('mousedown', start, button);
}
function lift() {
  if (button !== undefined) mouse('mouseup', last, button);
  button = undefined;
}
function begin({targetTouches, timeStamp}) {
  lift();
  start = last = middleOf(targetTouches);
  began = timeStamp;
  waits = targetTouches.length === 1;
  scrolls = !waits && overInterface(start);
  mouse('mouseenter', start);
  mouse('mousemove', start);
  if (!waits && !scrolls) press(right);
}
function move({targetTouches, timeStamp}) {
  const at = middleOf(targetTouches), across = Math.abs(at.x - start.x), along = Math.abs(at.y - start.y);
  if (waits) {
    if (Math.max(across, along) < slop) return;
    waits = false;
    const held = timeStamp - began >= hold, over = overInterface(start);
    scrolls = over && !held && along > across;
    if (!scrolls) press(over || held ? left : middle);
  }
  if (scrolls) turnWheel((at.y - last.y) / scrollStep);
  else mouse('mousemove', at);
  if (button === right && last.width && at.width) turnWheel(Math.log(last.width / at.width) / Math.log(zoomStep));
  last = at;
}
function end() {  // of two fingers, the other one does nothing more
  if (waits) press(left);  // a tap
  lift();
  mouse('mouseleave', last);
  start = null;
}
for (const [kind, act] of Object.entries({touchstart: begin, touchmove: move, touchend: end, touchcancel: end}))
  canvas.addEventListener(kind, event => {
    event.preventDefault();
    event.stopImmediatePropagation();
    if (start || kind === 'touchstart') act(event);
  }, {capture: true, passive: false});

load().catch(error =>
  refuse(error instanceof URIError ? 'The address is not well formed: write %25 for %.' : error.message));
