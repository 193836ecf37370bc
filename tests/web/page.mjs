#!/usr/bin/env node
// Tries the page in headless Chromium, and compares it with the desktop's program.
// Usage: page.mjs PAGE DESKTOP PICTURES
//   PAGE      the folder of the page
//   DESKTOP   the folder of what the desktop's program has written; see tests/checks.sh
//   PICTURES  the folder for screenshots

import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {extname, join} from 'node:path';

const [page, desktop, pictures] = process.argv.slice(2);
const width = 1280, height = 720, patience = 300_000;  // ms, for a busy machine without a graphics card
const said = [];                                       // by the page

function fail(text) {
  throw new Error(`${text}\n${said.join('\n')}`);
}

const types = {'.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm'};
const server = createServer((request, answer) => {
  const name = new URL(request.url, 'http://localhost').pathname.slice(1) || 'index.html';
  try {
    const bytes = readFileSync(join(page, name));
    answer.writeHead(200, {'Content-Type': types[extname(name)] ?? 'application/octet-stream', 'Content-Length': bytes.length});
    answer.end(bytes);
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise(done => server.listen(0, '127.0.0.1', done));
const address = `http://127.0.0.1:${server.address().port}/`;

// Chromium, by the DevTools protocol: messages of JSON, each with a zero byte at its end.
const chromium = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--remote-debugging-pipe',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', `--user-data-dir=${mkdtempSync(join(tmpdir(), 'chromium-'))}`,
  'about:blank'], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
const [, , , toBrowser, fromBrowser] = chromium.stdio;
const waiting = new Map();
let session, lastId = 0, unread = [];
function hear(message) {
  const {id, result, error, method, params} = JSON.parse(message);
  if (id) waiting.get(id)(error ? Promise.reject(new Error(error.message)) : result);
  if (method === 'Runtime.consoleAPICalled') said.push(params.args.map(value => value.value).join(' '));
  if (method === 'Runtime.exceptionThrown') said.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
}
fromBrowser.on('data', bytes => {
  for (let end; (end = bytes.indexOf(0)) >= 0; bytes = bytes.subarray(end + 1), unread = [])
    hear(Buffer.concat([...unread, bytes.subarray(0, end)]));
  unread.push(bytes);
});
function send(method, params = {}) {
  const id = ++lastId;
  toBrowser.write(JSON.stringify({id, method, params, sessionId: session}) + '\0');
  return new Promise(done => waiting.set(id, done));
}

/// Calls a function in the page and returns its result.
async function call(action, ...given) {
  const expression = `(${action})(...${JSON.stringify(given)})`;
  const {result, exceptionDetails} = await send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
  if (exceptionDetails) fail(exceptionDetails.exception?.description ?? exceptionDetails.text);
  return result.value;
}
/// Waits until a function returns true in the page.
async function until(what, action, ...given) {
  for (const end = Date.now() + patience; Date.now() < end; await new Promise(done => setTimeout(done, 100)))
    if (await call(action, ...given)) return;
  fail(`waited in vain until ${what}`);
}
/// Waits until the browser has drawn so many pictures: one handles what was sent before.
const drawn = count => call(left => new Promise(done => {
  const next = () => left-- ? requestAnimationFrame(next) : done();
  next();
}), count);

async function resize(size, touch) {
  await send('Emulation.setDeviceMetricsOverride', {
    ...size, screenWidth: size.width, screenHeight: size.height, deviceScaleFactor: 1, mobile: touch});
  await send('Emulation.setTouchEmulationEnabled', {enabled: touch});
}
async function press(key) {
  const event = {key, text: key, windowsVirtualKeyCode: key.toUpperCase().charCodeAt(0)};
  await send('Input.dispatchKeyEvent', {type: 'keyDown', ...event});
  await send('Input.dispatchKeyEvent', {type: 'keyUp', ...event});
  await drawn(1);
}
async function mouse(type, x, y) {
  await send('Input.dispatchMouseEvent', {type, x, y, button: type === 'mouseMoved' ? 'none' : 'left', clickCount: 1});
  await drawn(2);
}
async function touch(type, ...touchPoints) {
  await send('Input.dispatchTouchEvent', {type, touchPoints});
  await drawn(2);
}

/// Returns the share of pixels in which some channel differs by more than 32, as tests/app/pictures_test.cpp.
const differing = (one, other) => call(async (...pair) => {
  const [a, b] = await Promise.all(pair.map(async text => {
    const image = await createImageBitmap(await (await fetch('data:image/png;base64,' + text)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height).data;
  }));
  if (a.length !== b.length) return 1;
  let far = 0;
  for (let i = 0; i < a.length; i += 4) far += Math.max(...[0, 1, 2].map(k => Math.abs(a[i + k] - b[i + k]))) > 32;
  return far / (a.length / 4);
}, one, other);

async function screenshot(name) {
  const {data} = await send('Page.captureScreenshot');
  writeFileSync(join(pictures, `${name}.png`), data, 'base64');
  return data;
}
/// Fails unless the picture has changed since the one before. Returns it.
async function changed(name, before, least) {
  await drawn(5);
  const after = await screenshot(name), share = await differing(before, after);
  console.log(`${name}: ${(100 * share).toFixed(2)} % of the pixels have changed`);
  if (share < least) fail(`${name}: too few pixels have changed`);
  return after;
}

/// Runs a command in the page and returns the document that it prints.
const command = async (...words) => JSON.parse(await call(words => {
  printed.length = 0;
  callMain(words);
  return printed.join('\n');
}, words));
const result = name => JSON.parse(readFileSync(join(desktop, name)));
/// Returns true if the documents are equal, but for times, what depends on the number of threads, and the pair tests of
/// trees, which partial sorting by another library shapes otherwise. The hash says that the state is equal to the bit;
/// energies may differ in the last digits, by another library's logarithms.
function alike(ours, theirs) {
  if (typeof theirs === 'number') return Math.abs(ours - theirs) <= 1e-12 * Math.abs(theirs);
  if (theirs === null || typeof theirs !== 'object') return ours === theirs;
  return Object.keys(theirs).every(key => ['ms', 'threads', 'pair_tests'].includes(key) || alike(ours[key], theirs[key]));
}
function compare(name, ours) {
  if (!alike(ours, result(name))) fail(`${name} of the page differs from the desktop's`);
}

async function start() {
  await send('Page.navigate', {url: address + '?scene=drop'});
  await until('the page shows the program', () => window.Module?.calledRun && document.querySelector('#cover').hidden);
  await drawn(5);
}

/// 300 steps, each by a key: of three frames the picture is the right one.
async function takeSteps() {
  for (const key of ' rx') await press(key);
  for (let step = 0; step < 300; ++step) await press('n');
  const shown = await screenshot('frame_0300'), shares = {};
  for (const frame of [290, 300, 310])
    shares[frame] = await differing(shown, readFileSync(join(desktop, `frame_0${frame}.png`), 'base64'));
  console.log('pixels that differ from frame', shares);
  if (shares[300] > 0.02 || Math.min(shares[290], shares[310]) < 2 * shares[300] + 0.02)
    fail("the picture of frame 300 is not the desktop's");
  await press('p');
  await until('a picture is saved', () => saved.length > 0);
  const picture = await call(() => btoa(String.fromCharCode(...FS.readFile(saved[0]).subarray(16, 24))));  // its size
  const bytes = Buffer.from(picture, 'base64');
  if (bytes.readUInt32BE(0) !== width || bytes.readUInt32BE(4) !== height) fail('the saved picture has another size');
  await press('x');
}

async function takeInput() {
  let before = await screenshot('panel');
  await press('v');
  before = await changed('key', before, 0.01);
  await mouse('mouseMoved', 23, 331);
  await mouse('mousePressed', 23, 331);
  await mouse('mouseReleased', 23, 331);  // the overlay of the boxes
  await changed('click', before, 0.001);
  await resize({width: 390, height: 844}, true);
  await press('v');
  await press('h');
  await drawn(5);
  before = await screenshot('telephone');
  await touch('touchStart', {x: 120, y: 300});
  for (const x of [140, 180, 220]) await touch('touchMove', {x, y: 320});
  await touch('touchEnd');
  before = await changed('touch', before, 0.01);
  await call(text => {
    const files = new DataTransfer();
    files.items.add(new File([text], 'star.obj'));
    document.querySelector('#canvas').dispatchEvent(new DragEvent('drop', {dataTransfer: files}));
  }, readFileSync(join(import.meta.dirname, '../../assets/meshes/star.obj'), 'utf8'));
  await press(' ');
  await new Promise(done => setTimeout(done, 2000));
  await changed('drop', before, 0.001);
}

/// The state, the contacts and the misses are the desktop's.
async function runCommands() {
  compare('simulate.json', await command('simulate', '--scene=drop', '--frames=300', '--oracle', '--json'));
  // A frame with contacts, and cells so small that the paper's method misses them.
  await command('simulate', '--scene=drop', '--frames=138', '--obj-every=138', '--out=/made', '--json');
  const options = ['--method=all', '--tolerance=0.1', '--cell-size=0.2', '--json'];
  compare('detect.json', await command('detect', ...options, '/made/frame_0138.obj'));
  const median = ({frames}) => frames.map(frame => frame.ms.total).sort((a, b) => a - b)[frames.length >> 1];
  const [ours, theirs] = [await command('simulate', '--scene=D', '--frames=300', '--json'), result('D.json')].map(median);
  console.log(`D: ${ours.toFixed(2)} ms a frame, on the desktop ${theirs.toFixed(2)} ms on one thread`);
}

async function refuse() {
  await send('Page.navigate', {url: address + '?scene=nothing'});
  await until('it says what is wrong', () => document.querySelector('#text')?.textContent.includes('nothing'));
}

/// Runs in the page before its own scripts: keeps what the program prints and hands over as a download.
function listen() {
  window.printed = [];
  window.saved = [];
  let module;
  Object.defineProperty(window, 'Module', {get: () => module, set: value => {
    if (module) return;
    module = value;
    const print = module.print;
    module.print = line => (printed.push(line), print(line));
    module.download = path => saved.push(path);
  }});
}

let status = 1;
try {
  const {targetId} = await send('Target.createTarget', {url: 'about:blank'});
  ({sessionId: session} = await send('Target.attachToTarget', {targetId, flatten: true}));
  await send('Page.enable');
  await send('Runtime.enable');
  await send('Page.addScriptToEvaluateOnNewDocument', {source: `(${listen})()`});
  await resize({width, height}, false);
  await start();
  await takeSteps();
  await takeInput();
  await runCommands();
  await refuse();
  console.log('page: all is well');
  status = 0;
} catch (error) {
  console.error(`page: ${error.message}`);
}
chromium.kill();
process.exit(status);
