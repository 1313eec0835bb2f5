// The page beside the program `shutter` on the same scenes: in Chromium.

import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import {
  ROOT, SCENES, SOFT, bouncing, browser, choose, clipped, complaints, copied, copiedBy, curve, drag, dragged, drawn,
  drop, ended, extend, facts, fill, fitted, forgive, hold, link, measure, middle, open, page, planned, preset, problem,
  ready, refused, rows, scratch, see, setUp, settled, shutter, synced, ticks, told, trace, url, written,
} from './harness.js';

const SPEED = { name: 'a', kind: 'b', doubts: [], exposure: 1, error: 0, scatter: 0, pulses: 1 };

setUp();

const value = (id) => page.value(`#${id}`);
const number = async (id) => Number(await value(id));
const focused = () => page.evaluate(() => {
  const it = document.activeElement;
  return it.id || it.name || it.dataset.name;
});
const address = () => page.evaluate(() => designer.hash(designer.model.now));
const edge = () => page.evaluate(() => designer.originOf(designer.model.now.scene));
const isRead = () => page.until(() => designer.model.now.trace && !designer.model.pending && !designer.model.busy);
const isRefused = () => page.until(() => designer.model.pending && !designer.model.busy);
const isNamed = (name) => page.until((name) => document.getElementById('name').value === name, name);
const table = () => page.waitForSelector('#speeds:not([hidden])');
const speeds = () => rows('#speeds-table tbody');
const choice = (name, value) => page.fill(`#trace [name=${name}]`, value);
const json = async () => JSON.parse(await copied('json'));
const ticksOf = ({ triggers }) => triggers.map((it) => it.ticks);
/** Opens what a link holds. */
const follow = (link) => open(link.slice(url.length));

test('the first screen takes at most 90 kB, compressed, and all files 430 kB', async () => {
  await open('', { width: 1440, height: 900 });
  const first = await page.evaluate(() => {
    const [{ startTime }] = performance.getEntriesByName('ready');
    const before = performance.getEntriesByType('resource').filter((it) => it.startTime < startTime);
    return ['index.html', ...new Set(before.map((it) => new URL(it.name).pathname))];
  });
  assert.ok(first.length >= 4, String(first));
  const dist = join(ROOT, 'designer', 'dist'), all = readdirSync(dist, { recursive: true });
  const size = (path) => gzipSync(readFileSync(join(dist, path)), { level: 9 }).length;
  const packed = (paths) => paths.reduce((sum, path) => sum + size(path), 0) / 1000;
  const sums = [first, all.filter((path) => path.includes('.'))].map(packed);
  console.log(`first screen: ${first.length} files, ${sums[0].toFixed(1)} kB by gzip; all: ${sums[1].toFixed(1)} kB`);
  assert.ok(sums[0] <= 90 && sums[1] <= 430, String(sums));
});

test('each key of the program’s scene has a field', async () => {
  await open();
  // As docs/scene.md has them.
  const doc = readFileSync(join(ROOT, 'docs', 'scene.md'), 'utf8');
  const others = ['unit', 'shutteropening', 'trigger_times'];
  const keys = [...doc.matchAll(/^\| `(\w+)` \|/gm)].map(([, key]) => key).filter((key) => !others.includes(key));
  const known = await page.evaluate(() => Object.keys(designer.KINDS));
  assert.deepEqual(new Set(known.filter((key) => !/^[ty]\d$/.test(key))), new Set(keys));
  const missing = await page.evaluate(() => Object.keys(designer.KINDS).filter((id) => !document.getElementById(id)));
  assert.deepEqual(missing, ['fully_open']);
});

test('wrong numbers stay as they are typed, with the reason and what would help', async () => {
  await open();
  const before = await curve();
  for (const [id, text, message] of [
    ['t1', '2', /^t1: opening ramp: the time of its first inner point has to lie on the ramp, .*; it is 2/],
    ['y6', '-1', /^y6: closing ramp: the openness of its second inner point has to be in \[0, 1\]; it is -1/],
    ['open_end', 'NaN', /“NaN” is no number/], ['close_end', '1e400', /“1e400” is beyond all numbers/],
    ['close_start', '-4', /times out of order/], ['close_end', '0', /^closed at: times out of order/],
    ['triggers', '0', /^how many: a whole number from 1 to 10000/], ['triggers', '', /^how many: a number is required/],
    ['triggers', '12.5', /“12\.5” is no whole number/], ['min_gap', '-1', /^least gap: 0 or more is required/],
    ['min_gap', '5', /^how many: triggers 0 and 1 come .* apart, and 5 ms .*is required; 1 trigger keeps that/],
    ['nominal', 'x', /“x” is no number/], ['timer_bits', '24', /^timer, bits: 16 or 32 is required/],
    ['timer_hz', '2.5', /^how many: triggers 0 and 1 come 0 ms .*apart, and 333\.33 ms .*is required/],
    ['delay', '-9', /^sync delay: triggers 0 to \d+ come, .* before the edge of the sync/],
  ]) {
    const last = await value(id);
    await fill({ [id]: text });
    await see({ problem: message, '!problem': /`|--[a-z]/, [id]: text });
    // Flashes that come too close are told where their number is.
    const at = /^how many: triggers/.test(await problem()) ? 'triggers' : id;
    assert.equal(await page.attribute(`#${at}`, 'aria-invalid'), 'true', id);
    assert.ok(await page.isDisabled('#copy'));
    assert.equal(await curve(), before);
    await fill({ [id]: last });
    await see({ '#problem': false });
  }
  // Nor do the facts say anything of what is refused.
  await fill({ delay: '3', timer_bits: '8' });
  await see({ '#facts': false });
  await fill({ timer_bits: '', min_gap: '5' });
  await told();
  await page.push('Use 1 flash');
  await see({ '#problem': false, triggers: '1' });
  await page.click('#undo');
  await told();
  await page.push('Ask for no gap');
  await see({ '#facts': true, triggers: '12', min_gap: '0' });
  // A time takes its ramp along.
  await fill({ open_end: '8' });
  await see({ t1: '0.2', t2: '0.3', t5: '0.85' });
});

test('numbers are read as people write them, and any other is refused', async () => {
  await open();
  for (const [id, text, value] of [
    ['min_gap', '0,25', 0.25], ['min_gap', '0.125', 0.125], ['open_start', '−0,5', -0.5], ['open_start', '-.5e0', -0.5],
    ['min_gap', '0', 0], ['nominal', '1/125 s', 8], ['nominal', '500', 2], ['nominal', '1/500', 2],
    ['nominal', '8 ms', 8], ['nominal', '2 s', 2000], ['nominal', '0.5', 500],
    ['timer_hz', '1 MHz', 1_000_000], ['timer_hz', '2,5 kHz', 2500],
    ['open_end', '2400µs', 2.4], ['min_gap', '5e4 ns', 0.05], ['timer_hz', '32.768 kHz', 32768],
    ...['12 000 us', '1 1/2 s', '1/1 000', '1\u202f5', '1.0,5', '1,2.5'].map((no) => ['min_gap', no, 'is no number']),
    ['open_end', '1,500 ms', 'may mean 1.5 or 1500:'], ['open_end', '1/1,000', 'may mean 1 or 1000:'],
    ['open_end', '2.5', 2.5], ['timer_hz', '1.000 Hz', 'may mean 1 or 1000:'], ['timer_hz', '1e6', 1e6],
    ['open_end', '2 kHz', 'has an unknown unit'],
  ]) {
    await fill({ [id]: text });
    if (typeof value === 'string') {
      assert.ok((await problem()).includes(value), text);
      continue;
    }
    await see({ '#problem': false });
    assert.equal(Number((await copied('toml')).match(new RegExp(`^${id} = (.*)$`, 'm'))[1]), value, text);
    await page.blur(`#${id}`);
    if (id !== 'nominal') await see({ [id]: String(value) });
  }
});

test('nothing is cut at 1440, 1024, 390 and 320 pixels, nor with large letters; a finger reads and drags', async () => {
  const long = link({
    triggers: 10000, timer_hz: 100000000, min_gap: 0.0012345, pulse: 0.012345, delay: 1234.5678, sync_falls: true,
  }, {
    open_start: -1234.5678, open_end: 1262.68902, close_start: 4671.17877, close_end: 8710.60274, nominal: 12345.678,
    shutteropening: [0.1227014, 0.0005208, 0.1941086, 0.9329666, 0.75, 0.91, 0.87, 0.001],
  }, { unit: 'µs' });
  await open(long, { width: 1024, height: 2800, hasTouch: true });
  await page.$eval('#inner', (it) => (it.open = true));
  const width = () => page.evaluate(() => document.documentElement.scrollWidth);
  for (const pixels of [1440, 1024, 390, 320]) {
    await page.resize(pixels, 5000);
    const cut = await page.$$eval('#numbers input:not([type]), #ticks :is(th, td), #facts dd, #readout', (all) =>
      all.filter((it) => it.offsetWidth && it.scrollWidth > it.clientWidth).map((it) => it.id || it.textContent));
    // The control points' seven digits do not fit half a phone.
    assert.deepEqual(pixels > 400 ? cut : cut.filter((id) => !/^[ty]\d$/.test(id)), [], String(pixels));
    assert.equal(await width(), pixels);
  }
  await open(link({ timer_hz: 4000, min_gap: 0 }), { width: 390, height: 844, hasTouch: true });
  assert.equal((await told(), await width()), 390, 'nor what is doubtful');
  for (const id of ['begin', 'graph']) assert.ok((await page.box(`#${id}`)).y < 500, 'it is on the first screen');
  const graph = await page.box('#graph');
  await page.touchscreen.tap(graph.x + graph.width / 2, graph.y + graph.height / 3);
  await see({ '#readout': /% open · .*% collected · flash \d+: tick \d+$/ });
  const [x, y] = await middle('t1'), session = await page.createCDPSession();
  const touch = (type, ...touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
  await touch('touchStart', { x, y });
  for (let i = 1; i <= 5; i++) await touch('touchMove', { x: x + 2 * i, y: y - 8 * i });
  await touch('touchEnd');
  assert.ok(await number('y1') > 0.1 && await number('t1') > 0.1);
  await page.resize(640, 2000);
  await page.evaluate(() => (document.documentElement.style.fontSize = '200%'));
  await drawn();
  assert.equal(await width(), 640);
});

test('handles in one place can each be taken, keys move each within its box, and the photograph follows', async () => {
  const triangle = { open_end: 50, close_start: 50, close_end: 100, shutteropening: null };
  await open(link({ triggers: 20, min_gap: 2 }, triangle));
  // A triangle opens into a trapezoid, to either side.
  await dragged('open_end', -60, 0);
  assert.ok(await number('open_end') < 45);
  await see({ close_start: '50' });
  await page.click('#undo');
  await dragged('open_end', 60, 0);
  assert.ok(await number('close_start') > 55);
  await see({ open_end: '50' });
  await open();
  const at = (name) => page.$eval(`#handle-${name}`, (it) =>
    ['min', 'now', 'max'].map((part) => Number(it.getAttribute(`aria-value${part}`))));
  // Pulled out of its box it slides along its side.
  await dragged('t1', 40, 200);
  await see({ y1: '0' });
  assert.ok(await number('t1') > 0.13, await value('t1'));
  await page.click('#undo');
  await page.focus('#handle-open_end');
  for (const [key, now] of [['End', 7.5], ['ArrowRight', 7.5], ['Home', 0], ['PageUp', 1], ['PageDown', 0]]) {
    await page.press(key);
    assert.deepEqual(await at('open_end'), [0, now, 7.5], key);
  }
  const photos = () => page.$$eval('.photos canvas', (all) => all.map((it) => it.toDataURL()));
  const first = await photos();
  await drag('close_start', -60, 0);
  assert.ok((await photos()).every((it, i) => it !== first[i]));
  await page.press('Escape');
  await page.mouse.up();
  assert.deepEqual(await photos(), first);
});

test('hardware gets nothing that nobody gave: the set-up, the timer’s rate, which way the sync goes', async () => {
  await open(link({ timer_hz: null, set_up: null, min_gap: null, delay: 1 }));
  for (const form of ['rust', 'c', 'csv', 'json']) {
    await choose(form);
    const lacks = /only you know: the set-up; the timer’s rate; the lamp’s least gap; which way the sync goes/;
    await see({ '#code': lacks });
    assert.ok(await page.isDisabled('#copy'));
  }
  await see({ facts: /timernone, so there are times[^]*gapnone asked[^]*set-upnot said: emulated, or/ });
  await see({ '!#ticks': /tick/ });
  assert.doesNotMatch(await copied('toml'), /set_up|timer_hz|min_gap/);
  await choose('rust');
  await page.push('The sync falls');
  await page.push('This shutter dims the lamp: in the path');
  await see({ facts: /dims the flashes to \d+(\.\d+)?, 100 and \d+(\.\d+)? %; “duty” = 0\.5/ });
  await page.push('It needs none');
  await page.push('Give the timer’s rate');
  assert.equal(await focused(), 'timer_hz');
  // A coarse timer is told where the timer is, and where the ticks are.
  await fill({ timer_hz: '4 kHz' });
  const [coarse] = /flashes move by up to \S+ % of a share/.exec(await planned('rust', 'soft'));
  for (const sel of ['#facts', '#ticks-note']) assert.ok((await page.text(sel)).includes(coarse), sel);
  await fill({ timer_hz: '1 MHz' });
  const rust = await copied('rust');
  assert.match(rust, /SYNC_FALLS: bool = true/);
  assert.equal(rust, await planned('rust', 'soft'));
  // A lamp that takes pulses: its module has no ticks that firmware could take for them.
  await fill({ min_gap: '0', lamp: 'duty' });
  assert.match(await copied('rust'), /^(?!.*\bTICKS: \[).*PULSES: \[\(u32, u32\)/s);
  await fill({ min_gap: '0.4', lamp: 'full' });
  assert.match(await copied('toml'), /^fully_open = true$/m);
  assert.deepEqual(await ticks(), ticksOf(JSON.parse(await planned('json', 'soft'))));
});

test('the delay ends at the opening: the edge of the sync stands still, whatever moves', async () => {
  // By a link: a curve that is drawn, with a delay that was told. Its times are counted from the edge.
  await open(link({ delay: 2, sync_falls: true }));
  const is = async (at, delay) => {
    await see({ delay, open_start: delay, facts: new RegExp(`delay${delay} ms from the sync's falling edge`) });
    const { triggers: [{ ticks, from_edge_ticks: from }] } = await json(), [first] = await rows('#ticks tbody');
    assert.deepEqual([(from - ticks) / 1000, Number(first.at(-1))], [Number(delay), from]);
    assert.equal(Number((await edge()).toFixed(6)), at);
  };
  await is(-2, '2');
  await fill({ open_start: '2.5' });
  await is(-2, '2.5');
  await page.focus('#handle-open_start');
  await page.press('ArrowRight');
  for (const handle of ['open_end', 't1', 'close_end']) await dragged(handle, 12, 8);
  await is(-2, '2.6');
  // Typed, letter by letter: the curve's times follow, and its shape stays.
  const shape = () => Promise.all(['t1', 'y2', 't6'].map(value));
  const before = await shape(), closed = await number('close_end');
  await page.$eval('#delay', (it) => it.select());
  await page.keyboard.type('3.125');
  await is(-2.525, '3.125');
  assert.deepEqual([await shape(), await number('close_end')], [before, Number((closed + 0.525).toPrecision(12))]);
  await page.press('Control+z');
  await is(-2, '2.6');
  // Without a delay there is no edge, nor which way it goes.
  await fill({ delay: '' });
  await see({ '#problem': false, sync_falls: '' });
  assert.equal(await page.attribute('path.edge', 'd'), '');
});

test('on a trace the edge stands where the sync has it, and nothing that a hand moved is taken away', async () => {
  await open('');
  await measure('two.csv', synced());
  await page.push('Choose its channel');
  assert.equal(await focused(), 'sync');
  await choice('sync', '3');
  await page.until(() => designer.model.now.scene.shutter.delay !== null && !designer.model.busy);
  // What is outside of a window does not count; it is in the unit of the file's times.
  await choice('from', '10 ms');
  await isRefused();
  await see({ '#trace .wrong': /no whole pulse/ });
  await choice('from', '0.001');
  await isRead();
  await see({ '#report pre': /^samples +1900,/m, sync_falls: 'true' });
  await fill({ timer_hz: '1 MHz', set_up: 'emulated', min_gap: '0' });
  const first = await edge(), text = await facts(), fit = await copied('toml'), delay = await number('delay');
  assert.match(text, /delay(2\.9|3\.0)\d* ms from the sync's falling edge.*known to± /s);
  assert.equal(await number('open_start'), delay, 'its times are counted from the edge');
  await fill({ open_start: String(delay + 0.5) });
  assert.ok(Math.abs((await edge()) - first) < 1e-9 && Math.abs((await number('delay')) - delay - 0.5) < 1e-6);
  assert.match(await copied('toml'), new RegExp(`^delay = ${await value('delay')}$`, 'm'));
  await page.push('Back to the fit');
  assert.deepEqual([await facts(), await copied('toml')], [text, fit]);
  // A delay that is typed stands beside the trace's, and counts; that it differs is told.
  await fill({ delay: '2.5' });
  await see({ facts: /delay2\.5 ms from the sync's falling edge.*the trace has/s, open_start: '2.5' });
  assert.match(await copied('rust'), /DELAY_TICKS: u32 = 2_500;/);
  assert.ok((await copied('toml')).startsWith(fit.split('[flashes]')[0]), 'what the fit wrote stays as it is');
  // Read otherwise, what is typed stays, until a person says so.
  const again = async (way) => {
    await choice('light', way);
    await page.says('the curve was changed by hand before');
  };
  await again('up');
  await see({ delay: '2.5' });
  await page.push('Show the fit');
  assert.ok(Math.abs((await number('delay')) - delay) < 1e-6);
  await fill({ delay: '' });
  await again('auto');
  await see({ delay: '' });
});

test('the keyboard alone gets from a preset to a copied module, in twelve stops of Tab; nothing moves', async () => {
  for (const [width, height] of [[1440, 900], [390, 844]]) {
    await open('', { width, height });
    await page.evaluate(() => {
      globalThis.shift = 0;
      const add = (list) => list.getEntries().forEach(({ value }) => (shift += value));
      new PerformanceObserver(add).observe({ type: 'layout-shift', buffered: true });
    });
    await written();
    const stops = [];
    while (stops.at(-1) !== 'copy' && stops.length < 40) {
      await page.press('Tab');
      stops.push(await focused());
      if (stops.at(-1) === 'leaf') await page.press('Enter');
    }
    assert.ok(stops.length <= 12 && stops.includes('leaf') && stops.includes('file'), `${width}: ${stops}`);
    assert.ok((await page.evaluate(() => shift)) < 0.05);
    await page.press('Enter');
    await page.until(() => /Copied/.test(document.getElementById('told').textContent));
    assert.match(await page.evaluate(() => navigator.clipboard.readText()), /pub const TICKS/);
    while ((await focused()) !== 'handle-t1') await page.press('Tab');
    const before = await number('t1');
    await page.press('ArrowRight');
    assert.equal(await number('t1'), before + 0.01);
  }
});

test('each form is saved under its name', async () => {
  await open();
  await preset('liquid-crystal');
  await page.evaluate(() => (HTMLAnchorElement.prototype.click = function () { globalThis.saved = this.download; }));
  const files = { rust: 'liquid_crystal.rs', c: 'liquid_crystal.h', toml: 'liquid-crystal.toml' };
  for (const [form, file] of Object.entries(files)) {
    await choose(form);
    await page.click('#save');
    await page.until((file) => globalThis.saved === file, file);
  }
});

test('a fit leaves what is not of the shutter, and is a step; what is wrong is mended where it is told', async () => {
  await open();
  const light = () => page.attribute('#graph path.trace', 'd');
  const opening = async () => await number('open_end') - await number('open_start');
  const made = (unit, value, header = '') => header + Array.from({ length: 800 }, (_, i) => {
    const f = i < 200 || i > 560 ? 0 : i < 280 ? (i - 200) / 80 : i < 440 ? 1 : (560 - i) / 120;
    return [...(unit ? [(i * unit).toPrecision(6)] : []), value(f + 0.01 * Math.sin(i * i)).toFixed(4)].join(',');
  }).join('\n');
  await fill({ lamp: 'pulse', pulse: '0.011', min_gap: '0.02', nominal: '1/125' });
  await page.blur('#nominal');
  const before = await address();
  // Times without a unit: seconds, until somebody says otherwise.
  await measure('bench.csv', made(0.01, (f) => 0.1 + 2 * f, 't,v\n'));
  await see({ '#facts .doubt': /does not say in which unit/ });
  const columns = ['time', 'columns'].map((name) => page.value(`#trace [name=${name}]`));
  assert.deepEqual(await Promise.all(columns), ['1', '2']);
  await page.push('Choose the unit');
  assert.equal(await focused(), 'unit');
  await choice('unit', 'ms');
  await page.until(() => designer.model.now.trace.asked.unit && !designer.model.busy);
  assert.ok(Math.abs(await opening() - 0.8) < 0.01);
  await see({ '!facts': /does not say/, pulse: '0.011', min_gap: '0.02', triggers: '12', lamp: 'pulse', nominal: '' });
  await see({ name: 'bench' });
  // Each is a step; with the first the trace goes as well.
  await page.click('#undo');
  assert.ok(await opening() > 700);
  await page.click('#undo');
  assert.deepEqual([await address(), await light()], [before, '']);
  await page.click('#redo');
  // A second file that is none: the first one's trace is said to stay.
  await drop(['notes.csv', 'dear diary,\nnothing happened\n']);
  await isRefused();
  await see({ '#trace': /notes\.csv.*no CSV.*The trace of bench\.csv stays/s });
  assert.ok((await light()).length > 1000);
  await page.push('Remove the trace');
  assert.equal(await light(), '');
  // No times: the rate mends it.
  await drop(['one.csv', made(0, (f) => 0.1 + 2 * f)]);
  await isRefused();
  await page.push('Give the rate');
  assert.equal(await focused(), 'rate');
  await page.keyboard.type('100,5e3');
  await page.keyboard.press('Enter');
  await isRead();
  assert.ok(Math.abs(await opening() - (80 / 100.5)) < 0.01);
  // Another column; and what is chosen before the last choice is read counts as well.
  await measure('down.csv', made(1e-5, (f) => 3 - 2 * f, 'time (s),dark,light\n').replace(/,(?=[\d.]+$)/gm, ',0.5,'));
  await hold();
  await choice('light', 'down');
  await choice('columns', '2');
  await page.evaluate(() => release());
  await isRefused();
  assert.equal(await page.value('#trace [name=light]'), 'down');
  assert.doesNotMatch(await page.text('main'), /--[a-z]|shutter fit/);
  await preset('box');
  await see({ '#trace .wrong': false });
});

test('a window is dragged on the whole record, in the file’s own time', async () => {
  await open('');
  const two = trace({ samples: 4000, more: (t) => (t > 20 && t < 24 ? 0.6 : 0) });
  await drop(['two.csv', two.replaceAll(/^[\d.]+/gm, (t) => (Number(t) + 5).toFixed(5))]);
  await isRead();
  const whole = await page.attribute('.record path', 'd');
  await page.$eval('#reading', (it) => (it.open = true));
  const ends = await page.$$eval('.record span', (all) => [all[0].textContent, all.at(-1).textContent]);
  assert.deepEqual(ends, ['5', '5.04']);
  const sweep = async (from, to) => {
    await page.$eval('.record', (it) => it.scrollIntoView({ block: 'center' }));
    const { x, y, width, height } = await page.box('.record svg');
    await page.mouse.move(x + from * width, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + to * width, y + height / 2, { steps: 3 });
    await page.mouse.up();
  };
  // From right to left as well.
  await sweep(0.4, 0.01);
  await page.until(() => designer.model.now.trace.asked.to);
  const { from, to } = await page.evaluate(() => designer.model.now.trace.asked);
  assert.ok(Math.abs(from - 5.0004) < 2e-4 && Math.abs(to - 5.016) < 2e-4, `${from} ${to}`);
  assert.equal(await page.attribute('.record path', 'd'), whole, 'all of it stays to be chosen from');
  // A part without a pulse is refused, and another is dragged there.
  await sweep(0.7, 0.95);
  await isRefused();
  await sweep(0.01, 0.4);
  await isRead();
  await page.push('take the whole record');
  await page.until(() => designer.model.now.trace.asked.to === null);
});

test('a scene in TOML is as it was written, and what is given in it stays; a broken one is refused', async () => {
  await open();
  const text = '[shutter]\nunit = "ms"\nopen_start = 0\nopen_end = 2\nclose_start = 6\nclose_end = 15\n'
    + '[flashes]\nunit = "us"\ntriggers = 7\ntimer_hz = 2000000\ntimer_bits = 16\nmin_gap = 250\ndelay = 1000\n'
    + 'delay_spread = 20\nsync_falls = true\nset_up = "emulated"\nlamp_lag = 1300\n';
  const file = join(scratch, 'short.toml');
  writeFileSync(file, text);
  await drop(['short.toml', text]);
  await isNamed('short');
  const plan = (form) => shutter('plan', file, '--emit', form);
  for (const form of ['json', 'c', 'rust']) assert.equal(await copied(form), plan(form), form);
  assert.match(plan('rust'), /u16/);
  // A lag beyond the delay is taken off each tick.
  assert.deepEqual(await ticks(), ticksOf(JSON.parse(plan('json'))));
  const [, drift] = /^drift +(.*)$/m.exec(shutter('plan', file));
  assert.ok((await facts()).includes(`drift${drift}`));
  await follow(await copiedBy(() => page.click('#link')));
  assert.equal(await copied('json'), plan('json'));
  for (const [name, text, message] of [
    ['mine', '[shutter]\nopen_end = "soon"\n', 'mine.toml:2: open_end: a number is required'],
    ['bare', '[shutter]\nopen_start = 0\ntrigger_times = [1, 2, 3.5]\n', 'and this page needs the curve'],
  ]) {
    await drop([`${name}.toml`, text]);
    await page.says(message);
  }
  await drop(['mine.toml', text], ['bench.csv', trace()]);
  await page.says('opened alone: no file beside it was read');
  await measure('mine.csv', trace());
  await see({ triggers: '7', timer_hz: '2000000', timer_bits: '16', min_gap: '0.25', delay: '', set_up: 'emulated' });
  // What a fit wrote, and a hand has changed since, stays doubted: here, and where it is taken to.
  const fit = readFileSync(join(SCENES, 'measured.toml'), 'utf8');
  for (const [name, text, is] of [['fit', fit, false], ['hand', fit.replace('2.6268898', '2.6268899'), true]]) {
    await drop([`${name}.toml`, text]);
    await isNamed(name);
    for (const words of [await facts(), await planned('rust', name)]) assert.equal(/by hand/.test(words), is, name);
  }
});

test('broken and huge traces get a message, and the page goes on', async () => {
  await open();
  const before = await copied('json');
  const told = async (message) => {
    await page.waitForSelector('#problem:not([hidden])');
    await see({ [(await page.evaluate(() => designer.model.pending)) ? '#trace .wrong' : '#problem']: message });
    await page.push('Close');
  };
  const long = () => Array.from({ length: 3e6 }, (_, i) => `${i}e-6,0.${100000 + ((i * 7919) % 1000)}`).join('\n');
  for (const [text, message] of [
    ['', /empty/], ['\0\u0001\u0002PNG', /binary/], ['<html><body>not found</body></html>', /no CSV/],
    ['t,v\n' + '1e308,-1e308\n'.repeat(1000), /./],
    ['t,v\n' + Array.from({ length: 2000 }, (_, i) => `${i}e-5,1`).join('\n'), /no pulse|sample/],
    [() => new Uint8Array(300 << 20), /300 MB: cut the trace/], [long, /stopped/],
  ]) {
    await drop(['broken.csv', text]);
    if (text === long) {
      // Meanwhile the page works.
      await page.waitForSelector('#busy:not([hidden])');
      await fill({ triggers: '13' });
      assert.equal((await ticks()).length, 13);
      await fill({ triggers: '12' });
      await page.push('Stop');
    }
    await told(message);
  }
  assert.equal(await copied('json'), before);
});

test('links of garbage get a message', async () => {
  const times = (...all) => link({}, Object.fromEntries(['open_start', 'open_end', 'close_start', 'close_end']
    .map((key, i) => [key, all[i]])));
  // What cannot be drawn, and what is refused all the same.
  const none = [
    '#%', '#%E0%A4%A', '#<script>alert(1)</script>', '#{}', '#7', '#null', `#${'a'.repeat(100_000)}`,
    ...[{ dial: -3 }, { dial: 0 }, { exposure: -1 }, { error: null }, { kind: 7 }].map((wrong) =>
      link({}, {}, { speeds: [{ ...SPEED, ...wrong }] })),
    times(3, 2, 1, 0), times(0, 0, 0, 0), times(0, 2, 1, 3), times(1e39, 2e39, 3e39, 4e39), times(0, '2', 5, 10),
    ...[{ own: [] }, { own: { open_start: 0, trigger_times: [1, 2] } }, { unit: '' }, { unit: 'parsec' },
      { speeds: [{}] }].map((more) => link({}, {}, more)),
    ...[[0.1, 0, 0.15, 1, 0.85, 1, 0.9, 2], [1, 2], 'x'].map((shutteropening) => link({}, { shutteropening })),
    ...[{ min_gap: '0' }, { delay: 'x' }, { timer_hz: [1, 2] }, { pulse: {} }].map((flashes) => link(flashes)),
  ];
  const garbage = [
    ...none, ...[{}, 7, { warnings: [[]] }].map((measured) => link({}, { measured })),
    ...[{ set_up: 'both' }, { triggers: 12.5 }, { triggers: 4294967295 }, { triggers: null }, { min_gap: 1e308 },
      { sync_falls: 1 }].map((flashes) => link(flashes)),
  ];
  for (const [i, hash] of garbage.entries()) {
    // As the page's first address, or typed into it.
    if (i % 4 === 0) await open(hash);
    else await page.evaluate((hash) => (location.hash = hash), hash);
    await page.until(() => document.querySelector('#problem:not([hidden])')?.textContent.length > 10)
      .catch(() => assert.fail(`nothing is told of ${hash.slice(0, 200)}`));
    // Nothing but the link's own curve is shown.
    const isSeen = await page.isSeen('#graph svg');
    assert.equal(isSeen, i >= none.length, hash.slice(0, 300));
    if (isSeen) assert.match(await curve(), /^M[\d .,LCHVM-]+$/, hash.slice(0, 80));
    else assert.ok(!(await page.isSeen('#code')) && (await page.isDisabled('#link')));
    assert.ok(await page.isDisabled('#copy'), hash.slice(0, 200));
    // A button leads out of it where a curve is lacking, and a preset anywhere.
    const ways = await page.$$eval('#problem button', (all) => all.map((it) => it.textContent));
    if (!isSeen) assert.deepEqual(ways, ['Go on without it'], hash.slice(0, 80));
    await preset('leaf');
    await see({ '#problem': false });
  }
});

test('axe finds nothing in any state of the page, in light and dark', async () => {
  await open();
  await page.evaluate(readFileSync(join(import.meta.dirname, '..', 'node_modules', 'axe-core', 'axe.min.js'), 'utf8'));
  const states = {
    plain: async () => {},
    words: () => page.push('What do the words mean?'),
    wrong: () => page.fill('#close_start', '-4'),
    trace: async () => {
      await page.click('#undo');
      await preset('measured');
      await fitted('leaf.csv');
      await page.$$eval('details', (all) => all.forEach((it) => (it.open = true)));
    },
    refused: async () => {
      await drop(['one.csv', refused()]);
      await page.waitForSelector('#trace .wrong');
    },
    doubted: () => measure('clipped.csv', clipped()),
    narrow: () => page.resize(390, 2800),
    table: async () => {
      await drop(['a.csv', clipped()], ['b.csv', trace()]);
      await table();
    },
  };
  for (const [name, enter] of Object.entries(states)) {
    await enter();
    assert.equal(await page.isSeen('#terms svg'), name === 'words');
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: colorScheme }]);
      assert.deepEqual(await page.evaluate(async () => {
        const { violations } = await axe.run(document, { resultTypes: ['violations'] });
        const told = (id) => ({ target, failureSummary }) => `${id}: ${target} ${failureSummary}`;
        return violations.flatMap(({ id, nodes }) => nodes.map(told(id)));
      }), [], `${name}, ${colorScheme}`);
    }
    if (name === 'words') await page.press('Escape');
  }
});

test('under any path the page is whole; where a script or the WebAssembly is missing, it says so', async () => {
  const types = { html: 'text/html', js: 'text/javascript', css: 'text/css', wasm: 'application/wasm' };
  for (const missing of [undefined, /engine\.wasm$/, /main.js$/]) {
    const fresh = extend(await browser.newPage());
    await fresh.setRequestInterception(true);
    fresh.on('request', (request) => {
      const file = join(ROOT, 'designer', 'dist', request.url().split('/a/path/')[1] || 'index.html');
      if (missing?.test(file) || !existsSync(file)) return request.respond({ status: 404 });
      request.respond({ contentType: types[file.split('.').pop()], body: readFileSync(file) });
    });
    await fresh.goto(`${url}a/path/`);
    if (!missing) await ready(fresh);
    else if (!missing.test('main.js')) await fresh.waitForSelector('#missing.now');
    await fresh.evaluate(() => document.getAnimations().forEach((animation) => animation.finish()));
    assert.equal(await fresh.isSeen('#missing'), Boolean(missing), String(missing));
    if (missing) assert.match(await fresh.text('#missing'), /^The page is not whole/);
    await fresh.close();
  }
});

test('a misfit takes the trace’s own times away; a change by hand is the curve’s', async () => {
  await open('');
  await measure('bounce.csv', bouncing());
  await see({ facts: /at the trace's own times/ });
  assert.doesNotMatch(await page.$eval('#hint', (it) => it.innerText), /Shaded/, 'no curve shares the exposure out');
  // Another number of them is asked of the trace.
  await fill({ triggers: '9' });
  await page.until(() => document.querySelectorAll('#ticks tbody tr').length === 9);
  const [own, shown, left] = [await copied('toml'), await curve(), await page.attribute('path.residual', 'd')];
  // A link holds them, without the trace.
  const link = await copiedBy(() => page.click('#link'));
  await drag('open_end', 30, 0);
  assert.notEqual(await page.attribute('path.residual', 'd'), left, 'what is left moves with the curve');
  await see({ '#by-hand': /Changed by hand.*misses the trace by/s });
  await page.mouse.up();
  await told();
  await see({ '!#facts dl': /own times|curve explains the trace/ });
  await page.push('Back to the fit');
  assert.deepEqual([await curve(), await copied('toml')], [shown, own]);
  await follow(link);
  assert.equal(await copied('toml'), own);
  await fill({ triggers: '8' });
  await see({ '#problem': /drop the trace again/ });
});

test('another shutter ends what is computed; a hand does not, and counts', async () => {
  await open('');
  await hold();
  await drop(['long.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  // The forms are written meanwhile; what would help stays the same button.
  assert.match(await copied('csv'), /^scene,index/);
  await see({ '#told': /^Copied/ });
  await fill({ min_gap: '5' });
  await see({ '#told': '' });
  await told();
  const help = await page.$('#problem button');
  await page.evaluate(() => held[0][0].onmessage({ data: { progress: 0.5 } }));
  await see({ '#busy': /Reading long\.csv: 50 %/ });
  assert.ok(await help.evaluate((it) => it.isConnected));
  const end = ended();
  await preset('trapezoid');
  await see({ '#problem': /^Reading long\.csv was stopped: another curve was chosen/ });
  await end;
  await drop(['bench.csv', trace()]);
  await fill({ triggers: '13' });
  await page.evaluate(() => release());
  await fitted('bench.csv');
  await see({ triggers: '13' });
  assert.equal(await page.evaluate(() => designer.model.now.trace.fit.triggers.length), 13);
  await fill({ timer_hz: '333333.4' });
  await see({ facts: /333333/ });
  // The fit comes, but takes nothing away that was drawn meanwhile.
  await hold();
  await drop(['drawn.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  await dragged('open_end', 20, 0);
  await see({ '#busy': true });
  const shown = await curve();
  await page.evaluate(() => release());
  await page.says('the curve was changed meanwhile');
  assert.equal(await curve(), shown);
  await page.push('Show the fit');
  await fitted('drawn.csv');
});

test('several traces are a table alone, which prints, and a link that holds it', async () => {
  await open();
  const all = { '250.csv': trace({ open: 1.5 }), '125.csv': trace({ open: 5.5 }), 'bounce.csv': bouncing() };
  await drop(...Object.entries(all), ['diary.csv', 'dear diary\nnothing\n']);
  await table();
  await see({ '#graph': false });
  const [short, bounce, long, diary] = await speeds();
  assert.deepEqual([short[0], bounce[0], long[0], diary[0]], ['250.csv', 'bounce.csv', '125.csv', 'diary.csv']);
  assert.deepEqual([short[2], long[2], short[4]], ['1/250', '1/125', '–']);
  assert.match(short[1], /^(3\.99|4\.00)\d* ± [\d.]+ ms/);
  assert.match(bounce[7], /the trace itself/);
  assert.match(diary[7], /^not measured: .*no row of numbers in it/);
  // Whoever knows what the dial says tells it.
  await page.fill('#speeds-table input', '250');
  assert.equal(await page.value('#speeds-table input'), '1/250');
  const told = await speeds();
  assert.match(told[0][4], /^[+−±]0\.0\d EV$/);
  const link = await copiedBy(() => page.click('#speeds-link'));
  await page.emulateMediaType('print');
  await see({ '#speeds': true, '#begin': false, '#speeds-link': false });
  await page.emulateMediaType('screen');
  // A trace that is refused is told of; closed, the table is there again.
  await drop(['bad.csv', refused()]);
  await isRefused();
  await see({ '#trace .wrong': true });
  await page.$$eval('#trace button', (all) => all.at(-1).click());
  await page.push('125.csv');
  await fitted('125.csv');
  // No speed of a dial is stated that nobody gave.
  assert.doesNotMatch(await page.text('.draw') + (await facts()), /EV|for 1/);
  await fill({ nominal: '1/100' });
  await see({ facts: /for 1\/100: .*EV/ });
  await page.click('#undo');
  await follow(link);
  assert.deepEqual(await speeds(), told);
  // Nor does a field that is wrong keep a table from being linked.
  await page.fill('#open_end', 'x');
  assert.match(await copiedBy(() => page.click('#speeds-link')), /speeds/);
  await page.click('#speeds-close');
  await see({ '#graph': true });
  // Of two files with one name each row opens its own, and Back is the table.
  await drop(['TEK0001.csv', trace({ open: 1.5 })], ['TEK0001.csv', trace({ open: 5.5 })]);
  for (const [row, exposure] of [[1, '^(7.9|8.0)'], [0, '^(3.9|4.0)']]) {
    await table();
    await settled();
    await page.$$eval('#speeds-table tbody button', (all, row) => all[row].click(), row);
    await page.until((source) => new RegExp(source).test(document.querySelector('#facts dd')?.textContent), exposure);
    await settled();
    await page.goBack();
  }
});

test('a part that cannot be drawn is told, and the address stays right', async () => {
  await open();
  await page.$eval('#ideal', (it) => it.remove());
  await page.focus('#open_end');
  await page.keyboard.type('5');
  await settled();
  await see({ '#missing': /could not be drawn: .*null/ });
  assert.ok(complaints.length);
  forgive();
});

test('a clipped trace is doubted on screen and paper, in every form, link and row; what is drawn is not', async () => {
  await open(link({ triggers: 20, min_gap: 0 }));
  await measure('clipped.csv', clipped());
  await see({ facts: /exposure7\.\d+ ± [\d.]+ ms\s*clipped: \d+ % of the pulse's samples[^]*testuntested/ });
  // On paper all of it stands, and no button.
  await page.emulateMediaType('print');
  await page.resize(700, 900);
  const cut = await page.$$eval('.scroll, #graph, summary, button', (all) => all.filter((it) => it.checkVisibility()
    && (it.matches('button') || it.scrollHeight > it.clientHeight + 1 || it.scrollWidth > it.clientWidth + 1)).length);
  assert.equal(cut, 0);
  await page.emulateMediaType('screen');
  const forms = ['rust', 'c', 'toml', 'json'];
  for (const form of forms) assert.match(await copied(form), /clipped: \d+ %/, form);
  JSON.parse(await copied('json'));
  const shared = await copiedBy(() => page.click('#link'));
  await dragged('open_end', 20, 0);
  for (const form of forms) assert.doesNotMatch(await copied(form), /clipped: \d/, form);
  assert.doesNotMatch(await address(), /measured/);
  await page.push('Back to the fit');
  assert.match(await copied('json'), /clipped: \d+ %/);
  await follow(shared);
  await see({ facts: /clipped: \d+ %/ });
  await drop(['clipped.csv', clipped()], ['clean.csv', trace()]);
  await table();
  const lines = await speeds();
  const isClipped = Object.fromEntries(lines.map(([name, measured]) => [name, /clipped: \d+ %/.test(measured)]));
  assert.deepEqual(isClipped, { 'clipped.csv': true, 'clean.csv': false });
  await follow(await copiedBy(() => page.click('#speeds-link')));
  assert.deepEqual(await speeds(), lines);
});
