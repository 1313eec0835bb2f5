// The page in a real browser, beside the program `shutter` on the same scenes. Run by designer/test.sh.

import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { chromium } from 'playwright-core';

const ROOT = join(import.meta.dirname, '..', '..');
const SHUTTER = process.env.SHUTTER;
const SCENES = join(ROOT, 'cli', 'scenes');
// Everything within one ramp or the other: the most that a curve can ask of the crate.
const ALL_RAMP = '#name=ramps&unit=ms&times=0,5,5,10&inner=0.2,0,0.3,1,0.7,1,0.8,0&triggers=256&timer_hz=10000000&min_gap=0';
const scratch = mkdtempSync(join(tmpdir(), 'designer-'));

let server, url, browser, page;
// What went wrong in the page, and what it asked of whom.
let complaints, requests;

before(async () => {
  server = spawn(SHUTTER, ['design', '--no-open', '--port', '0', '--page', join(ROOT, 'designer', 'dist')], { stdio: ['ignore', 'pipe', 'inherit'] });
  const [told] = await once(server.stdout, 'data');
  url = String(told).match(/http:\S+/)[0];
  const args = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'];
  browser = await chromium.launchPersistentContext(join(scratch, 'profile'), {
    executablePath: process.env.CHROMIUM, args, viewport: { width: 1360, height: 2800 }, hasTouch: true,
    permissions: ['clipboard-read', 'clipboard-write'], acceptDownloads: true,
  });
});

after(async () => {
  await browser?.close();
  server?.kill();
  rmSync(scratch, { recursive: true, force: true });
});

// Tall, so that all panels are seen, and written.
async function open(hash = '', size = { width: 1360, height: 2800 }) {
  page = await browser.newPage();
  [complaints, requests] = [[], []];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => requests.push(request.url()));
  await page.setViewportSize(size);
  await page.goto(url + hash);
  await page.waitForSelector('body[data-ready]');
  await page.evaluate(() => (document.getElementById('inner').open = true));
}

// No test leaves an error on the console, nor a request to anyone else.
afterEach(async () => {
  if (!page) return;
  await page.close();
  page = null;
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((asked) => !asked.startsWith(url) && !asked.startsWith('blob:')), []);
});

const shutter = (...args) => execFileSync(SHUTTER, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const clipboard = () => page.evaluate(() => navigator.clipboard.readText());

/** A form as it is copied. */
async function copied(form) {
  await page.click(`#form-${form}`);
  await page.evaluate(() => navigator.clipboard.writeText('nothing'));
  await page.click('#copy');
  for (let i = 0; i < 500; i++) {
    const text = await clipboard();
    if (text !== 'nothing') return text;
    await page.waitForTimeout(20);
  }
  assert.fail(`${form} was not copied`);
}

/** The scene as it is copied, planned by the program. */
async function planned(form = 'json', name = 'copied') {
  const file = join(scratch, `${name}.toml`);
  writeFileSync(file, await copied('toml'));
  return shutter('plan', file, '--emit', form);
}

const ticks = () => page.$$eval('#ticks tbody tr', (rows) => rows.map((row) => Number(row.children[3].textContent)));
const handle = (name) => page.locator(`#handle-${name} > :last-child`);
const curve = () => page.getAttribute('#graph path.curve', 'd');

async function middle(name) {
  const { x, y, width, height } = await handle(name).boundingBox();
  return [x + width / 2, y + height / 2];
}

/** Drags a handle by so many pixels; it is let go with `page.mouse.up()`. */
async function drag(name, dx, dy) {
  await handle(name).scrollIntoViewIfNeeded();
  const [x, y] = await middle(name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 5 });
}

/** Drops a file on the page; `text` may be a function that makes it there. */
async function drop(name, text) {
  await page.evaluate(([name, text, isCode]) => {
    const content = isCode ? eval(text)() : text;
    const data = new DataTransfer();
    data.items.add(new File([content], name));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
  }, [name, String(text), typeof text === 'function']);
}

test('the first screen takes at most 100 KB, compressed', async () => {
  await open('', { width: 1360, height: 900 });
  const first = [...new Set(requests.map((asked) => new URL(asked).pathname))].filter((path) => !/(worker\.js|studio\.wasm|sw\.js)$/.test(path));
  assert.ok(first.length >= 9, String(first));
  const size = (path) => gzipSync(readFileSync(join(ROOT, 'designer', 'dist', path === '/' ? 'index.html' : path)), { level: 9 }).length;
  const sum = first.reduce((sum, path) => sum + size(path), 0);
  console.log(`first screen: ${first.length} files, ${(sum / 1000).toFixed(1)} kB by gzip, of which engine.wasm ${(size(first.find((path) => path.endsWith('engine.wasm'))) / 1000).toFixed(1)}`);
  assert.ok(sum <= 100_000, String(sum));
});

test('every preset has the bits that the program has', async () => {
  await open();
  const names = readdirSync(SCENES).map((file) => file.replace('.toml', ''));
  assert.deepEqual((await page.locator('#presets b').allTextContents()).sort(), names.sort());
  for (const name of names) {
    await page.click(`#presets [data-name="${name}"]`);
    assert.equal(await copied('json'), shutter('plan', join(SCENES, `${name}.toml`), '--emit', 'json'), name);
  }
});

test('a handle is dragged, and the ticks are the program’s', async () => {
  await open();
  const before = await ticks();
  await drag('open_end', 83, 0);
  assert.notDeepEqual(await ticks(), before, 'before the handle is let go');
  await page.mouse.up();
  await drag('t2', -31, 47);
  await page.mouse.up();
  const host = JSON.parse(await planned('json', 'soft'));
  assert.deepEqual(await ticks(), host.triggers.map((trigger) => trigger.ticks));
  assert.deepEqual(JSON.parse(await copied('json')), host);
  assert.ok(Number(await page.inputValue('#open_end')) > 3);
  assert.ok(Number(await page.inputValue('#y2')) < 0.9);
});

test('a time takes its ramp along and keeps its shape', async () => {
  await open();
  await page.fill('#open_end', '5');
  assert.equal(await page.inputValue('#t1'), '0.2');
  assert.equal(await page.inputValue('#t2'), '0.3');
  assert.equal(await page.inputValue('#t5'), '0.85');
});

test('wrong numbers stay as they are typed, with the reason', async () => {
  await open();
  const before = await curve();
  for (const [id, text, message] of [
    ['t1', '2', /opening ramp: time turns back/],
    ['y6', '-1', /closing ramp: the openness falls below 0/],
    ['open_end', 'NaN', /“NaN” is no number/],
    ['close_end', '1e400', /close_end: a finite number is required/],
    ['close_start', '-4', /times out of order/],
    ['triggers', '1.5', /triggers: a whole number/],
    ['triggers', '0', /triggers: 1 to 10000 can be planned/],
    ['triggers', '99999999999', /triggers: a whole number/],
    ['timer_hz', '', /timer_hz: a whole number/],
    ['min_gap', '-1', /min_gap: 0 or more is required/],
    ['min_gap', '5', /triggers 0 and 1 come .* apart/],
    ['nominal', 'x', /“x” is no number/],
  ]) {
    const last = await page.inputValue(`#${id}`);
    await page.fill(`#${id}`, text);
    assert.match(await page.textContent('#problem'), message, `${id} ${text}`);
    assert.equal(await page.inputValue(`#${id}`), text);
    // Triggers that come too close are told where their number is.
    const place = text === '5' ? 'triggers' : id;
    assert.equal(await page.getAttribute(`#${place}`, 'aria-invalid'), 'true', id);
    assert.ok(await page.isDisabled('#copy'));
    assert.equal(await curve(), before);
    await page.fill(`#${id}`, last);
    assert.ok(await page.isHidden('#problem'), id);
  }
});

test('each copied form compiles or parses', async () => {
  await open();
  const crate = join(scratch, 'crate');
  execFileSync('mkdir', ['-p', join(crate, 'src')]);
  writeFileSync(join(crate, 'Cargo.toml'), `[package]\nname="copied"\nedition="2024"\n[dependencies]\nshutter-curve={path=${JSON.stringify(ROOT)}}\n[workspace]\n`);
  let lib = '';
  for (const name of ['soft', 'box', 'led', 'projector']) {
    await page.click(`#presets [data-name="${name}"]`);
    assert.equal(await copied('rust'), await planned('rust', name));
    writeFileSync(join(crate, 'src', `of_${name}.rs`), await copied('rust'));
    lib += `pub mod of_${name};\n`;
    writeFileSync(join(scratch, 'copied.h'), await copied('c'));
    execFileSync('cc', ['-std=c99', '-Wall', '-Wextra', '-Wno-unused-variable', '-Wno-unused-const-variable', '-Werror', '-fsyntax-only', '-x', 'c', join(scratch, 'copied.h')]);
    const json = JSON.parse(await copied('json'));
    const [head, ...rows] = (await copied('csv')).trim().split('\n').map((row) => row.split(','));
    assert.deepEqual(rows.map((row) => Number(row[head.indexOf('ticks')])), json.triggers.map((trigger) => trigger.ticks));
    assert.equal(await planned('json', name), await copied('json'), 'the TOML is the same scene');
  }
  writeFileSync(join(crate, 'src', 'lib.rs'), lib);
  execFileSync('cargo', ['check', '--quiet', '--offline'], { cwd: crate, stdio: 'inherit' });
});

test('a link is a curve', async () => {
  await open();
  await page.click('#presets [data-name="led"]');
  await drag('close_start', -40, 0);
  await page.mouse.up();
  await page.fill('#name', 'my "curve" & <b>µ</b>');
  await page.waitForFunction(() => location.hash.includes('my'));
  await page.click('#link');
  const [link, json, toml] = [await clipboard(), await copied('json'), await copied('toml')];
  await page.close();
  await open(link.slice(url.length));
  assert.equal(await copied('json'), json);
  assert.equal(await copied('toml'), toml);
  assert.equal(await page.inputValue('#name'), 'my "curve" & <b>µ</b>');
});

test('the keyboard alone gets from a preset to a copied static', async () => {
  await open();
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.dataset.name);
  const tabTo = async (id) => {
    for (let i = 0; i < 80; i++) {
      if ((await focused()) === id) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`no way to ${id}`);
  };
  await tabTo('leaf');
  await page.keyboard.press('Enter');
  await tabTo('handle-t1');
  const before = await page.inputValue('#t1');
  await page.keyboard.press('ArrowRight');
  assert.equal(Number(await page.inputValue('#t1')), Number(before) + 0.01);
  await page.keyboard.press('Shift+ArrowUp');
  assert.equal(await page.inputValue('#y1'), '0.001');
  await page.keyboard.press('ArrowDown');
  assert.equal(await page.inputValue('#y1'), '0', 'not below');
  assert.ok(await page.isHidden('#problem'));
  for (const name of ['open_start', 'open_end', 'close_start', 'close_end', 't1', 't2', 't5', 't6']) {
    const handle = page.locator(`#handle-${name}`);
    assert.ok(await handle.getAttribute('aria-label'));
    assert.match(await handle.getAttribute('aria-valuetext'), /\d/);
  }
  await tabTo('copy');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => /Copied/.test(document.getElementById('told').textContent));
  assert.match(await clipboard(), /pub static SHUTTER: ShutterCurve = valid\(/);
  await tabTo('form-rust');
  await page.keyboard.press('ArrowRight');
  assert.equal(await focused(), 'form-c');
  // Every control has a name.
  const nameless = await page.$$eval('input, select, button', (all) => all.filter((it) => !(it.labels?.length || it.textContent.trim() || it.ariaLabel)).map((it) => it.id));
  assert.deepEqual(nameless, []);
});

test('on a phone nothing overflows, and a finger drags', async () => {
  await open('', { width: 390, height: 844 });
  for (const name of ['soft', 'strobe', 'led']) {
    await page.click(`#presets [data-name="${name}"]`);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, name);
  }
  await page.click('#presets [data-name="soft"]');
  await handle('t1').scrollIntoViewIfNeeded();
  const [x, y] = await middle('t1');
  const session = await browser.newCDPSession(page);
  const touch = (type, ...touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
  await touch('touchStart', { x, y });
  for (let i = 1; i <= 5; i++) await touch('touchMove', { x: x + 2 * i, y: y - 8 * i });
  await touch('touchEnd');
  assert.ok(Number(await page.inputValue('#y1')) > 0.1, await page.inputValue('#y1'));
  assert.ok(Number(await page.inputValue('#t1')) > 0.1);
});

test('256 triggers on all ramp follow the mouse', async () => {
  await open(ALL_RAMP);
  assert.equal((await ticks()).length, 256);
  const session = await browser.newCDPSession(page);
  await session.send('Performance.enable');
  const script = async () => {
    const { metrics } = await session.send('Performance.getMetrics');
    const of = (name) => metrics.find((metric) => metric.name === name).value;
    return [of('ScriptDuration'), of('LayoutDuration') + of('RecalcStyleDuration')].map((s) => 1000 * s);
  };
  await handle('t2').scrollIntoViewIfNeeded();
  const [x, y] = await middle('t2');
  await page.mouse.move(x, y);
  await page.mouse.down();
  let before = await ticks();
  const median = (durations, k) => durations.map((both) => both[k]).sort((a, b) => a - b)[durations.length / 2];
  let best = Infinity;
  // What else runs on the machine counts as well: the best of three.
  for (let run = 0; run < 3 && best >= 8; run++) {
    const durations = [];
    for (let i = 1; i <= 60; i++) {
      const [script0, layout0] = await script();
      await page.mouse.move(x - 2 * (i % 30), y + i);
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const [script1, layout1] = await script();
      durations.push([script1 - script0, layout1 - layout0]);
      if (i % 10) continue;
      const now = await ticks();
      assert.notDeepEqual(now, before, 'each move counts');
      before = now;
    }
    best = Math.min(best, median(durations, 0));
    console.log(`60 moves with 256 triggers on all ramp: script ${median(durations, 0).toFixed(2)} ms a move (median), ${Math.max(...durations.map(([s]) => s)).toFixed(2)} ms (most); style and layout ${median(durations, 1).toFixed(2)} ms`);
  }
  await page.mouse.up();
  assert.ok(best < 8, String(best));
});

/** A trace of a shutter with straight ramps: 2 ms up, 4 ms open, 3 ms down, with a little noise. */
function trace() {
  let seed = 1;
  const noise = () => ((seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5) * 0.02;
  let text = 'time_s,voltage_v\n';
  for (let i = 0; i < 1500; i++) {
    const t = i * 1e-5;
    const f = t < 3e-3 || t > 12e-3 ? 0 : t < 5e-3 ? (t - 3e-3) / 2e-3 : t < 9e-3 ? 1 : (12e-3 - t) / 3e-3;
    text += `${t.toFixed(6)},${(0.1 + 2.4 * (f + noise())).toFixed(4)}\n`;
  }
  return text;
}

test('a dropped trace is fitted as the program fits it', async () => {
  await open();
  await drop('bench.csv', trace());
  await page.waitForSelector('#trace dl');
  const [file, scene] = [join(scratch, 'bench.csv'), join(scratch, 'bench.toml')];
  writeFileSync(file, trace());
  shutter('fit', file, '--zero', 'open', '--out', scene);
  assert.deepEqual(JSON.parse(await copied('json')), JSON.parse(shutter('plan', scene, '--emit', 'json')));
  assert.match(await page.textContent('#trace'), /straight ramps/);
  assert.match(await page.textContent('#trace'), /residual/);
  assert.ok((await page.getAttribute('#graph path.trace', 'd')).length > 1000);
  assert.ok(Math.abs(Number(await page.inputValue('#open_end')) - 2) < 0.05);
  // The example that is there to be tried.
  await page.click('#example');
  await page.waitForFunction(() => /leaf\.csv/.test(document.getElementById('trace').textContent) && document.querySelector('#trace dl'));
  shutter('fit', join(ROOT, 'cli', 'traces', 'leaf.csv'), '--zero', 'open', '--out', scene);
  assert.deepEqual(JSON.parse(await copied('json')).triggers, JSON.parse(shutter('plan', scene, '--emit', 'json')).triggers);
  await page.click('#trace button:text-is("Remove the trace")');
  assert.equal(await page.getAttribute('#graph path.trace', 'd'), '');
});

test('a dropped scene is opened, and a broken one refused with its line', async () => {
  await open();
  await drop('mine.toml', readFileSync(join(SCENES, 'projector.toml'), 'utf8'));
  await page.waitForFunction(() => document.getElementById('name').value === 'mine');
  assert.equal((await ticks()).length, 20);
  await drop('mine.toml', 'open_start = 0\nopen_end = "soon"\n');
  await page.waitForSelector('#trace .wrong');
  assert.match(await page.textContent('#trace'), /mine:2: a number is required/);
  assert.equal((await ticks()).length, 20);
});

test('broken and huge traces get a message, and the page goes on', async () => {
  await open();
  const before = await copied('json');
  const refused = async (message) => {
    await page.waitForSelector('#trace .wrong', { timeout: 60_000 });
    assert.match(await page.textContent('#trace .wrong'), message);
    await page.evaluate(() => document.querySelector('#trace .wrong').remove());
  };
  for (const [text, message] of [
    ['', /empty/],
    ['\0\u0001\u0002PNG', /binary/],
    ['<html><body>not found</body></html>', /no CSV/],
    ['time,volt\n0,1\n1,1\n', /sample/],
    ['t,v\n' + 'nan,nan\n'.repeat(1000), /./],
    ['t,v\n' + '1e308,-1e308\n'.repeat(1000), /./],
    ['t,v\n' + Array.from({ length: 2000 }, (_, i) => `${i}e-5,1`).join('\n'), /no pulse|sample/],
  ]) {
    await drop('broken.csv', text);
    await refused(message);
  }
  // 50 MB: of no numbers, and of numbers without a pulse.
  await drop('huge.csv', () => 'volt;garbage;;;'.repeat(3_500_000));
  await refused(/huge\.csv: /);
  await drop('huge.csv', () => Array.from({ length: 50 }, (_, k) => Array.from({ length: 60_000 }, (_, i) => `${(k * 60_000 + i)}e-6,0.${100000 + ((i * 7919) % 1000)}`).join('\n')).join('\n'));
  // Meanwhile the page works.
  await page.fill('#triggers', '13');
  assert.equal((await ticks()).length, 13);
  await page.fill('#triggers', '12');
  await refused(/huge\.csv: /);
  await drop('huge.csv', () => new Uint8Array(300 << 20));
  await refused(/300 MB: cut the trace/);
  assert.equal(await copied('json'), before);
});

test('a fit is stopped', async () => {
  await open();
  await drop('long.csv', () => Array.from({ length: 50 }, (_, k) => Array.from({ length: 60_000 }, (_, i) => `${(k * 60_000 + i)}e-6,0.${100000 + ((i * 7919) % 1000)}`).join('\n')).join('\n'));
  await page.click('#trace button:text-is("Stop")');
  await page.waitForSelector('#trace .wrong');
  assert.match(await page.textContent('#trace'), /stopped/);
  assert.match(await copied('rust'), /static SHUTTER/, 'the next question is answered');
});

test('links of garbage get a message', async () => {
  const garbage = ['#%', '#%E0%A4%A', '#<script>alert(1)</script>', '#times=1', '#times=0,1,2,3', '#' + 'a'.repeat(100_000), '#times=,,,&triggers=&timer_hz=&min_gap=',
    ALL_RAMP.replace('unit=ms', 'unit=parsec'), ALL_RAMP.replaceAll(/=[\d.,]+/g, '=NaN'), ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, 'NaN'),
    ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, '1e308'), ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, '-Infinity'), ALL_RAMP.replace('triggers=256', 'triggers=4294967295')];
  for (const hash of garbage) {
    await open(hash);
    assert.ok(await page.isVisible('#problem'), hash.slice(0, 80));
    assert.ok((await page.textContent('#problem')).length > 10, hash.slice(0, 80));
    // Nothing but the link's own curve is shown.
    if (await page.isVisible('#graph svg')) assert.match(await curve(), /^M[\d .,LCHVM-]+$/, hash.slice(0, 80));
    else assert.ok(await page.isHidden('#code'));
    assert.ok(await page.isDisabled('#link'));
    // A preset leads out of it.
    await page.click('#presets [data-name="soft"]');
    assert.ok(await page.isHidden('#problem'));
    assert.equal((await ticks()).length, 12);
    assert.deepEqual(complaints, []);
    await page.close();
  }
  page = null;
});

test('the most triggers are shown without a hang', async () => {
  await open(ALL_RAMP.replace('triggers=256', 'triggers=10000'));
  assert.equal((await ticks()).length, 300);
  assert.equal(JSON.parse(await copied('json')).triggers.length, 10_000);
  assert.match(await page.textContent('#ticks-note'), /9700/);
});

test('without a network it goes on, and opens again', async () => {
  await open();
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller);
  await browser.setOffline(true);
  try {
    await page.reload();
    await page.waitForSelector('body[data-ready]');
    await drag('t1', 30, -30);
    await page.mouse.up();
    assert.deepEqual(JSON.parse(await copied('json')), JSON.parse(await planned('json', 'soft')));
  } finally {
    await browser.setOffline(false);
  }
});

test('the picture is saved as an SVG', async () => {
  await open();
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#svg')]);
  assert.equal(download.suggestedFilename(), 'soft.svg');
  const svg = readFileSync(await download.path(), 'utf8');
  const blank = await browser.newPage();
  const found = await blank.evaluate((svg) => {
    const parsed = new DOMParser().parseFromString(svg, 'image/svg+xml');
    return [parsed.querySelectorAll('parsererror, .handle').length, parsed.querySelectorAll('path').length];
  }, svg);
  await blank.close();
  assert.equal(found[0], 0);
  assert.ok(found[1] > 20);
});

test('the server gives nothing but the page', async () => {
  const ask = (request) => new Promise((resolve) => {
    const { port, hostname } = new URL(url);
    let answer = '';
    const socket = connect(Number(port), hostname, () => socket.write(request));
    socket.on('data', (data) => (answer += data)).on('close', () => resolve(answer)).on('error', () => resolve(answer));
  });
  for (const path of ['/../Cargo.toml', '/..%2fCargo.toml', '/%2e%2e/Cargo.toml', '//etc/passwd', '/../../../../etc/passwd', '/.', '/index.html/', '/style.css\\..\\x', '']) {
    assert.match(await ask(`GET ${path} HTTP/1.1\r\nHost: localhost\r\n\r\n`), /^HTTP\/1\.1 404 /, path);
  }
  assert.match(await ask('POST / HTTP/1.1\r\nHost: 127.0.0.1:8417\r\n\r\n'), /^HTTP\/1\.1 405 /);
  assert.match(await ask('GET / HTTP/1.1\r\nhost: [::1]\r\n\r\n'), /^HTTP\/1\.1 200 OK[^]*Content-Type: text\/html/);
  // A page elsewhere whose name is made to point here reads nothing.
  for (const host of ['Host: evil.example', 'Host: localhost.evil.example', 'Host: 127.0.0.1.evil.example', 'Host: localhost:x', 'X: localhost', 'Host: ']) {
    assert.match(await ask(`GET / HTTP/1.1\r\n${host}\r\n\r\n`), /^HTTP\/1\.1 403 /, host);
  }
  await ask('\0\u0001\r\n\r\n');
  await ask(`GET /${'a'.repeat(1 << 16)} HTTP/1.1\r\n\r\n`);
  assert.match(await ask('GET /?x HTTP/1.1\r\nHost: LOCALHOST:1\r\n\r\n'), /^HTTP\/1\.1 200 /, 'and goes on');
});
