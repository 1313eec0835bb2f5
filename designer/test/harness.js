// The page in a real browser, by one driver; and the program `shutter` beside it. Run by designer/test.sh.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before } from 'node:test';
import { context } from 'esbuild';
import { launch } from 'puppeteer-core';

export const ROOT = join(import.meta.dirname, '..', '..');
export const SCENES = join(ROOT, 'cli', 'scenes');
export const scratch = mkdtempSync(join(tmpdir(), 'designer-'));
const SHUTTER = process.env.SHUTTER;

export let url, browser, page;
let server;
/** What went wrong in the page, and what it asked of whom. */
export let complaints, requests;
export const forgive = () => (complaints.length = 0);

export const shutter = (...args) =>
  execFileSync(SHUTTER, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

// No calls to their makers, and no sandbox, which a container has not.
const QUIET = ['sync', 'gpu', 'quic', 'background-networking', 'component-update'].map((it) => `--disable-${it}`);
const BROWSERS = {
  chrome: { executablePath: process.env.CHROMIUM, args: ['--no-sandbox', '--no-first-run', ...QUIET] },
  firefox: { executablePath: process.env.FIREFOX },
};

/** Begins with a server and a browser. No test leaves an error on the console, nor a request to anyone else. */
export function setUp(name = 'chrome') {
  before(async () => {
    server = await context({});
    const { port } = await server.serve({ host: '127.0.0.1', servedir: join(ROOT, 'designer', 'dist') });
    url = `http://127.0.0.1:${port}/`;
    browser = await launch({ browser: name, headless: true, timeout: 120_000, ...BROWSERS[name] });
    const clipboard = ['read', 'write', 'sanitized-write'].map((it) => `clipboard-${it}`);
    if (name === 'chrome') await browser.defaultBrowserContext().overridePermissions(url.slice(0, -1), clipboard);
  });
  after(async () => {
    await browser?.close();
    await server?.dispose();
    rmSync(scratch, { recursive: true, force: true });
  });
  afterEach(async () => {
    if (!page) return;
    if (!page.isClosed()) await page.close();
    page = null;
    assert.deepEqual(complaints, []);
    assert.deepEqual(requests.filter((asked) => !asked.startsWith(url) && !/^(blob|data):/.test(asked)), []);
  });
}

/** A link to a scene; without more, to that with which most tests begin. */
export const link = (flashes, shutter, more) => `#${encodeURI(JSON.stringify({
  name: 'soft', unit: 'ms', ...more,
  shutter: {
    open_start: 0, open_end: 2.5, close_start: 7.5, close_end: 10,
    shutteropening: [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0], ...shutter,
  },
  flashes: { triggers: 12, timer_hz: 1e6, min_gap: 0.4, set_up: 'emulated', ...flashes },
}))}`;
export const SOFT = link();

/** Opens the page. */
export async function open(hash = SOFT, size = { width: 1360, height: 2800 }) {
  if (page && !page.isClosed()) await page.close();
  page = extend(await browser.newPage());
  [complaints, requests] = [[], []];
  page.on('console', (message) => ['error', 'warn'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => requests.push(request.url()));
  await page.setViewport(size);
  await page.goto(url + hash);
  await ready();
  return page;
}

export async function ready(on = page) {
  await on.waitForSelector('body[data-ready]');
  await drawn(on);
}

/** Until a frame is drawn, and the page's observers are told of it. */
export const drawn = (on = page) =>
  on.evaluate(() => new Promise((done) => new IntersectionObserver(done).observe(document.body)));

/** Until the program has told of what is on the screen. */
export const told = () => page.until(() => {
  const { told, now, wrong } = designer.model;
  return wrong?.reason || told?.scene === now.scene;
});

/** What is told of what is on the screen, and what is wrong with it. */
export const facts = async () => (await told(), page.text('#facts'));
export const problem = async () => (await told(), page.text('#problem'));

/** Until the form of what is on the screen is written. */
export const written = () => page.until(() => !document.getElementById('code').classList.contains('waits'));

/** Until the address is that of what is on the screen: a step that comes sooner shares its entry. */
export const settled = () => page.until(() => location.hash === designer.hash(designer.model.now));

/** Fits do not begin until `release()` in the page. */
export const hold = () => page.evaluate(() => {
  const { postMessage } = Worker.prototype;
  globalThis.held = [];
  Worker.prototype.postMessage = function (message) {
    if (message.kind === 'fit') held.push([this, message]);
    else postMessage.call(this, message);
  };
  globalThis.release = () => {
    Worker.prototype.postMessage = postMessage;
    for (const [worker, message] of held) worker.postMessage(message);
  };
});

/** Until the next worker is ended: what it computes never comes. */
export const ended = () => new Promise((done) => page.once('workerdestroyed', done));

/** The page with what a test asks of it. */
export function extend(page) {
  const on = (sel, act, ...args) => page.$eval(sel, act, ...args);
  page.setDefaultTimeout?.(Number(process.env.PATIENCE ?? 60_000));
  return Object.assign(page, {
    text: (sel) => on(sel, (it) => it.textContent),
    attribute: (sel, name) => on(sel, (it, name) => it.getAttribute(name), name),
    value: (sel) => on(sel, (it) => it.value),
    isSeen: (sel) => page.$$eval(sel, (all) => Boolean(all[0]?.checkVisibility({ visibilityProperty: true }))),
    isDisabled: (sel) => on(sel, (it) => it.disabled),
    focus: (sel) => on(sel, (it) => it.focus()),
    blur: (sel) => on(sel, (it) => it.blur()),
    fill: (sel, value) => on(sel, (it, value) => {
      it.focus();
      if (it.type === 'checkbox') return it.checked === value || it.click();
      it.value = value;
      for (const type of ['input', 'change']) it.dispatchEvent(new Event(type, { bubbles: true }));
    }, value),
    until: (what, ...args) => page.waitForFunction(what, {}, ...args),
    /** Until the page says so. */
    says: (words) => page.until((words) => document.body.innerText.includes(words), words),
    press: async (keys) => {
      const all = keys.split('+');
      for (const key of all.slice(0, -1)) await page.keyboard.down(key);
      await page.keyboard.press(all.at(-1));
      for (const key of all.slice(0, -1).reverse()) await page.keyboard.up(key);
    },
    /** A button by its words. */
    push: (words) => page.evaluate((words) => {
      const all = [...document.querySelectorAll('button')];
      const found = all.find((it) => it.textContent === words && it.checkVisibility());
      if (!found) throw new Error(`no button ${words}`);
      found.focus();
      found.click();
    }, words),
    resize: async (width, height) => {
      await page.setViewport({ width, height });
      await page.until((width) => innerWidth === width, width);
      await drawn(page);
    },
    box: async (sel) => (await page.$(sel)).boundingBox(),
  });
}

/** Until a trace is read, and nothing more is computed. */
export const fitted = (name) => page.until((name) =>
  document.querySelector('#facts h3')?.textContent === name && document.getElementById('busy').hidden, name);

export const preset = (name) => page.$eval(`#presets [data-name="${name}"]`, (it) => it.click());

/** What an action copies. */
export async function copiedBy(act) {
  await page.evaluate(() => navigator.clipboard.writeText('nothing'));
  await act();
  const copied = await page.until(async () => {
    const text = await navigator.clipboard.readText();
    return text !== 'nothing' && text;
  });
  return copied.jsonValue();
}

/** A form, once it is written. */
export async function choose(form) {
  await page.$eval(`#form-${form}`, (it) => it.click());
  await written();
}

/** A form as it is copied. */
export async function copied(form) {
  await choose(form);
  return copiedBy(() => page.$eval('#copy', (it) => it.click()));
}

/** The scene as it is copied, planned by the program. */
export async function planned(form = 'json', name = 'copied') {
  const file = join(scratch, `${name}.toml`);
  writeFileSync(file, await copied('toml'));
  return shutter('plan', file, '--emit', form);
}

/** What stands in the rows of a table. */
export const rows = (sel) =>
  page.$$eval(`${sel} tr`, (all) => all.map((row) => [...row.children].map((it) => it.textContent)));
export const ticks = async () => (await rows('#ticks tbody')).map((row) => Number(row[3]));
export const curve = () => page.attribute('#graph path.curve', 'd');
export const values = () => page.$$eval('[role=slider]', (all) => all.map((it) => it.getAttribute('aria-valuenow')));

export async function middle(name) {
  await page.$eval(`#handle-${name}`, (it) => it.scrollIntoView({ block: 'nearest' }));
  const { x, y, width, height } = await page.box(`#handle-${name} > :last-child`);
  return [x + width / 2, y + height / 2];
}

/** Drags a handle by so many pixels; it is let go with `page.mouse.up()`. */
export async function drag(name, dx, dy) {
  const [x, y] = await middle(name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 5 });
}

/** Drags a handle, and lets it go. */
export async function dragged(...how) {
  await drag(...how);
  await page.mouse.up();
}

/** Drops files on the page; a text may be a function that makes it there. */
export async function drop(...files) {
  await page.evaluate((files) => {
    const data = new DataTransfer();
    for (const [name, text, isCode] of files) data.items.add(new File([isCode ? eval(text)() : text], name));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
  }, files.map(([name, text]) => [name, String(text), typeof text === 'function']));
}

/** Drops a trace, and waits for its fit. */
export async function measure(name, text) {
  await drop([name, text]);
  await fitted(name);
}

/** Types in fields, one after the other. */
export async function fill(values) {
  for (const [id, value] of Object.entries(values)) await page.fill(`#${id}`, value);
}

/**
 * What is seen: `facts`, what is the `problem`, the value of a field by its id, what an element says by its selector;
 * behind `!` what is not, or whether an element is seen.
 */
export async function see(wanted) {
  for (const [key, is] of Object.entries(wanted)) {
    const [, not, what] = /^(!?)(.*)$/.exec(key), isElement = /^[#.[]/.test(what);
    if (typeof is === 'boolean') assert.equal(await told().then(() => page.isSeen(what)), is, what);
    else {
      const all = { facts, problem }, ask = all[what] ?? (() => isElement ? page.text(what) : page.value(`#${what}`));
      const text = await ask();
      if (typeof is === 'string') assert.equal(text, is, what);
      else assert[not ? 'doesNotMatch' : 'match'](text, is, what);
    }
  }
}

/** A trace: it opens in `up`, is open for `open`, closes in `down`, in ms; with noise, and what `more` adds. */
export function trace({
  up = 2, open = 4, down = 3, from = 3, step = 0.01, samples = 1500, more = () => 0, seed = 1, noise = 0.01,
} = {}) {
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5;
  let text = 'time_s,voltage_v\n';
  for (let i = 0; i < samples; i++) {
    const t = i * step - from;
    const f = t < 0 || t > up + open + down ? 0 : t < up ? t / up : t < up + open ? 1 : (up + open + down - t) / down;
    text += `${((i * step) / 1000).toPrecision(7)},${(0.1 + 2.4 * (f + more(t) + 2 * noise * random())).toFixed(4)}\n`;
  }
  return text;
}

/** One with a sync beside it, which falls 3 ms before the opening. */
export function synced() {
  const [head, ...samples] = trace({ from: 5, samples: 2000 }).trim().split('\n');
  return [`${head},sync_v`, ...samples.map((row) => `${row},${row.split(',')[0] < 0.002 ? 3.3 : 0.1}`)].join('\n');
}

/** One whose shutter bounces, which no curve explains. */
export const bouncing = () => trace({ noise: 0.002, more: (t) => sine(t, 9.6, 10.4, 0.3) + sine(t, 3, 4.4, -0.12) });

/** Half a period. */
export const sine = (t, from, to, height) =>
  t > from && t < to ? height * Math.sin((Math.PI * (t - from)) / (to - from)) : 0;

/** One whose amplifier stops at 60 % of its light. */
export const clipped = () =>
  trace({ noise: 0.002 }).replace(/,([\d.]+)$/gm, (_, v) => `,${Math.min(v, 0.1 + 2.4 * 0.6).toFixed(4)}`);

/** What is no trace that can be fitted as it is. */
export const refused = () => Array.from({ length: 900 }, (_, i) => (i > 300 && i < 600 ? 1 : 0)).join('\n');
