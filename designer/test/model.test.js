// One model, one render: nothing on the screen is of another state than the rest. In Chromium.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { bouncing, browser, choose, copied, copiedBy, curve, drag, drawn, drop, ended, extend, hold, middle, open, page, played, preset, ready, scratch, setUp, settled, shutter, ticks,
  trace, url, written } from './harness.js';

setUp();

const code = () => page.text('#code');
const fitted = (name) => page.until((name) => document.querySelector('#trace h3')?.textContent === name && document.querySelector('#trace dl'), name);

test('a fit keeps no delay and no nominal speed of the last shutter, nor a gap that nobody gave', async () => {
  await open();
  await preset('measured');
  await page.fill('#delay', '3');
  await page.fill('#nominal', '1/125');
  await drop(['mine.csv', trace()]);
  await fitted('mine.csv');
  assert.deepEqual([await page.value('#delay'), await page.value('#nominal'), await page.value('#min_gap')], ['', '', '0']);
  assert.doesNotMatch(await copied('rust'), /DELAY/);
  // A number that a person gave for this trace stays when it is read otherwise.
  await page.fill('#nominal', '1/125');
  await page.fill('#min_gap', '0.05');
  await page.blur('#min_gap');
  await page.fill('#trace [name=rises]', 'true');
  await page.until(() => document.querySelector('#trace dl') && document.querySelector('#trace [name=rises]').value === 'true' && document.getElementById('busy').hidden);
  assert.deepEqual([await page.value('#nominal'), await page.value('#min_gap')], ['8', '0.05']);
});

test('a fast shutter of one’s own works at its first drop', async () => {
  await open();
  await drop(['fast.csv', trace({ up: 0.4, open: 2.6, down: 0.5 })]);
  await fitted('fast.csv');
  assert.ok(!(await page.isSeen('#problem')));
  assert.match(await page.text('#speed'), /^1\/3\d\d s/);
  assert.match(await copied('rust'), /pub const TICKS: \[u32; 12\]/);
});

test('a shutter whose flashes do not fit is what is shown, undone and redone; what would help is a button', async () => {
  await open();
  await page.fill('#min_gap', '0.4');
  await page.fill('#triggers', '12');
  await page.blur('#triggers');
  await drop(['fast.csv', trace({ up: 0.4, open: 2.6, down: 0.5 })]);
  await fitted('fast.csv');
  assert.match(await page.text('#speed'), /^1\/3\d\d s/, 'not the shutter before');
  assert.ok(await page.isSeen('#problem'));
  assert.match(await page.text('#problem'), /come 0\.\d+ ms apart, and 0\.4 ms is required/, 'in the unit that is shown');
  assert.ok((await page.isDisabled('#copy')) && (await page.isDisabled('#save')));
  assert.match(await code(), /^There is nothing to copy yet/);
  for (const id of ['ticks', 'ticks-note', 'set-ups']) assert.ok(!(await page.isSeen(`#${id}`)), id);
  assert.deepEqual(await page.$$eval('[data-panel] .head', (all) => all.map((it) => /no plan/.test(getComputedStyle(it, '::after').content))), [true, true]);
  // It is seen wherever one is.
  assert.ok(await page.$eval('#problem', (it) => it.getBoundingClientRect().bottom <= innerHeight));
  const shape = await curve();
  await page.click('#undo');
  assert.notEqual(await curve(), shape);
  assert.ok(!(await page.isSeen('#problem')));
  await page.click('#redo');
  assert.equal(await curve(), shape);
  await page.push('Use 7 flashes');
  assert.ok(!(await page.isSeen('#problem')));
  assert.equal(await page.value('#triggers'), '7');
  assert.match(await copied('rust'), /TICKS: \[u32; 7\]/);
  await page.click('#undo');
  await page.push('Ask for no gap');
  assert.equal((await ticks()).length, 12);
});

test('a misfit takes the trace’s own triggers away, as the program does; a change by hand is the curve’s, and says so', async () => {
  await open();
  await drop(['bounce.csv', bouncing()]);
  await fitted('bounce.csv');
  const [file, scene] = [join(scratch, 'bounce.csv'), join(scratch, 'bounce.toml')];
  writeFileSync(file, bouncing());
  const times = (text) => /trigger_times = \[([^\]]*)\]/.exec(text)[1].split(',').map(Number).filter((x) => x);
  const program = (n) => {
    shutter('fit', file, '--zero', 'open', '--triggers', String(n), '--out', scene);
    return readFileSync(scene, 'utf8');
  };
  assert.deepEqual(times(await copied('toml')), times(program(12)));
  const json = JSON.parse(await copied('json'));
  assert.deepEqual(json.triggers.map((it) => it.ticks), JSON.parse(shutter('plan', scene, '--emit', 'json')).triggers.map((it) => it.ticks));
  assert.deepEqual(await ticks(), json.triggers.map((it) => it.ticks));
  // The bounce is on the graph, whole.
  const light = await page.evaluate(() => Math.max(...document.querySelector('path.trace').getAttribute('d').match(/[\d.]+ [\d.]+/g).map((at) => at.split(' ').map(Number)).filter(([, y]) => y < 150).map(([x]) => x)));
  assert.ok(light < (await page.evaluate(() => Number(document.querySelector('#plot rect').getAttribute('width')))), String(light));
  assert.match(await page.text('#trace'), /at the trace’s own times/);
  assert.equal((await page.$eval('#trace', (it) => it.innerText)).match(/structure/g).length, 1);
  // No curve shares the exposure out.
  assert.doesNotMatch(await page.$eval('#hint', (it) => it.innerText), /Shaded/);
  // Another number of them is asked of the trace.
  await page.fill('#triggers', '9');
  await page.until(() => document.querySelectorAll('#ticks tbody tr').length === 9);
  assert.deepEqual(times(await copied('toml')), times(program(9)));
  const own = await copied('toml');
  // A link holds them, without the trace.
  const link = await copiedBy(() => page.click('#link'));
  const samples = () => page.attribute('path.residual', 'd');
  const [before, shown] = [await samples(), await curve()];
  await drag('open_end', 30, 0);
  assert.notEqual(await samples(), before, 'what is left moves with the curve');
  await page.until(() => /Changed by hand.*misses the trace by/.test(document.getElementById('trace').textContent));
  await page.mouse.up();
  assert.doesNotMatch(await page.text('#trace'), /own times|curve explains|trace's own/);
  assert.match(await copied('toml'), /close_end/);
  await page.push('Back to the fit');
  assert.equal(await curve(), shown);
  assert.equal(await copied('toml'), own);
  await open(link.slice(url.length));
  assert.equal(await copied('toml'), own);
  await page.fill('#triggers', '8');
  assert.match(await page.text('#problem'), /drop the trace again/);
  assert.ok(await page.isDisabled('#copy'));
});

test('a misfit without triggers of its own takes nothing away, until a person insists', async () => {
  await open();
  // Too little dark beside the pulse.
  const dip = (t) => (t > 3 && t < 4.4 ? -0.2 * Math.sin((Math.PI * (t - 3)) / 1.4) : 0);
  await drop(['dip.csv', trace({ from: 0.2, samples: 930, noise: 0.002, more: dip })]);
  await fitted('dip.csv');
  const isDoubted = async () => {
    await written();
    assert.match(await code(), /^There is nothing to copy yet: no curve explains this trace/);
    for (const id of ['copy', 'save', 'link', 'frame', 'svg', 'png']) assert.ok(await page.isDisabled(`#${id}`), id);
  };
  await isDoubted();
  const text = await page.$eval('#trace', (it) => it.innerText);
  assert.match(text, /the model's, and off by more than their errors say/);
  assert.doesNotMatch(text, /by the curve\n/);
  await settled();
  const address = await page.evaluate(() => location.hash);
  await page.push('Use the curve all the same');
  assert.match(await copied('rust'), /static SHUTTER/);
  await page.click('#undo');
  await isDoubted();
  await open(address);
  await isDoubted();
});

test('what a drag leaves of the trace is drawn and told while it is dragged', async () => {
  await open();
  await drop(['bench.csv', trace()]);
  await fitted('bench.csv');
  await page.says('the curve explains the trace');
  const before = await page.attribute('path.residual', 'd');
  await drag('close_start', -40, 0);
  assert.notEqual(await page.attribute('path.residual', 'd'), before);
  const told = Number(/misses the trace by ([\d.]+) %/.exec(await page.text('#trace'))[1]);
  assert.ok(told > 3, String(told));
  assert.doesNotMatch(await page.text('#trace'), /the curve explains the trace/);
  await page.press('Escape');
  await page.mouse.up();
  assert.equal(await page.attribute('path.residual', 'd'), before);
  await page.says('the curve explains the trace');
});

test('a scene in TOML is as it was written, to the bits of its timer, and what a person gave in it stays', async () => {
  await open();
  const text = 'unit = "ms"\nopen_start = 0\nopen_end = 2\nclose_start = 6\nclose_end = 15\ntriggers = 7\ntimer_hz = 2000000\ntimer_bits = 16\nmin_gap = 0.25\ndelay = 1\n';
  const file = join(scratch, 'short.toml');
  writeFileSync(file, text);
  await drop(['short.toml', text]);
  await page.until(() => document.getElementById('name').value === 'short');
  for (const form of ['rust', 'json', 'c']) assert.equal(await copied(form), shutter('plan', file, '--emit', form), form);
  assert.match(await copied('rust'), /u16/);
  const link = await copiedBy(() => page.click('#link'));
  // What holds the handle is the timer, and is told.
  await drag('close_end', 100, 0);
  await page.until(() => !document.getElementById('hold').hidden);
  assert.match(await page.text('#hold'), /^timer, bits: the frame ends at tick \d+, and a count of 16 bits/);
  await page.mouse.up();
  await page.push('Take a timer of 32 bits');
  assert.equal(await page.value('#timer_bits'), '');
  assert.ok(Number(await page.value('#close_end')) > 15.5);
  await open(link.slice(url.length));
  assert.equal(await copied('json'), shutter('plan', file, '--emit', 'json'));
  await drop(['short.toml', text]);
  await page.until(() => document.getElementById('told').textContent === 'Opened short.toml.');
  await drop(['mine.csv', trace()]);
  await fitted('mine.csv');
  assert.deepEqual(await Promise.all(['triggers', 'timer_hz', 'timer_bits', 'min_gap', 'delay'].map((id) => page.value(`#${id}`))), ['7', '2000000', '16', '0.25', '']);
});

test('a scene of trigger times without a curve is refused, with the reason', async () => {
  await open();
  const shown = await curve();
  await drop(['bare.toml', 'open_start = 0\ntrigger_times = [1, 2, 3.5]\ntimer_hz = 1000\nmin_gap = 0\n']);
  await page.waitForSelector('#problem.wrong');
  assert.match(await page.text('#problem'), /^bare\.toml: these are trigger times as they were measured, and this page needs the curve/);
  assert.equal(await curve(), shown);
});

test('after how many frames a delay that moves matters is told as the program tells it', async () => {
  await open();
  assert.ok(!(await page.isSeen('#drift')));
  await preset('measured');
  const scene = join(scratch, 'measured.toml');
  writeFileSync(scene, await copied('toml'));
  const [, told] = /^drift +(.*)$/m.exec(shutter('plan', scene));
  assert.equal((await page.text('#drift')).toLowerCase(), `${told}.`);
  assert.match(told, /in \d+ frames$/);
});

test('the spread of a scene’s delay is kept, in the unit that is shown', async () => {
  await open();
  await preset('measured');
  await drop(['jitters.toml', `${await copied('toml')}delay_spread = 0.02\n`]);
  await page.until(() => document.getElementById('name').value === 'jitters');
  assert.equal(await page.value('#delay_spread'), '0.02');
  await page.fill('#unit', 'µs');
  assert.match(await copied('toml'), /^delay_spread = 20$/m);
});

test('what is told of a preset is not told of another curve, and no dose covers the next', async () => {
  await open();
  assert.ok(await page.isSeen('#story'));
  await page.fill('#triggers', '11');
  assert.ok(!(await page.isSeen('#story')));
  await preset('liquid-crystal');
  assert.ok(await page.isSeen('#story'));
  const bars = await page.$$eval('#set-ups .dose', (all) => all.map((it) => [...it.getAttribute('d').matchAll(/M([\d.]+) .*?H([\d.]+)/g)].map(([, from, to]) => [Number(from), Number(to)])));
  assert.equal(bars.length, 3);
  for (const row of bars) assert.ok(row.length === 16 && row.every(([from], i) => i === 0 || from > row[i - 1][1]), String(row));
});

test('what is pointed at is of the curve that is there', async () => {
  await open();
  await page.focus('#handle-open_end');
  await page.press('ArrowRight');
  const told = await page.text('#readout');
  await page.fill('#triggers', '11');
  assert.notEqual(await page.text('#readout'), told);
  await page.focus('#presets [data-name="liquid-crystal"]');
  await page.press('Enter');
  assert.notEqual(await page.text('#readout'), told);
});

test('a reload keeps the steps, and Back and Forward among them', async () => {
  await open();
  const states = [await curve()];
  const done = async (act) => {
    await act();
    await settled();
    states.push(await curve());
  };
  await done(() => preset('leaf'));
  await done(() => preset('box'));
  await done(() => preset('projector'));
  await page.goBack();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') === d, states[2]);
  await page.reload();
  await ready();
  assert.equal(await curve(), states[2]);
  await page.goBack();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') === d, states[1]);
  await page.goForward();
  await page.goForward();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') === d, states[3]);
  for (const k of [2, 1, 0]) {
    await page.click('#undo');
    assert.equal(await curve(), states[k]);
  }
  await page.click('#redo');
  assert.equal(await curve(), states[1]);
  // A trace as well, but for its file.
  await drop(['bench.csv', trace()]);
  await fitted('bench.csv');
  await settled();
  await page.reload();
  await ready();
  await fitted('bench.csv');
  assert.ok((await page.attribute('path.trace', 'd')).length > 1000);
  assert.match(await page.text('#trace'), /open the file again/);
});

test('an undo during a drag ends the drag', async () => {
  await open();
  await preset('leaf');
  const before = await curve();
  await drag('open_end', 40, 0);
  assert.notEqual(await curve(), before);
  await page.press('Control+z');
  assert.equal(await curve(), before);
  const [x, y] = await middle('open_end');
  await page.mouse.move(x + 60, y, { steps: 4 });
  await page.mouse.up();
  assert.equal(await curve(), before);
  assert.equal(await page.attribute('#presets [data-name="leaf"]', 'aria-pressed'), 'true');
  // So does the browser's Back.
  await settled();
  await drag('open_end', 40, 0);
  await page.goBack();
  await page.until(() => document.querySelector('#presets [data-name="soft"]').ariaPressed === 'true');
  await page.mouse.move(x + 90, y, { steps: 4 });
  await page.mouse.up();
  assert.equal(await page.attribute('#presets [data-name="soft"]', 'aria-pressed'), 'true');
  await page.goForward();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') === d, before);
});

test('a newer choice ends what is computed, which says so meanwhile and never comes after', async () => {
  await open();
  await hold();
  await drop(['long.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  assert.match(await page.text('#busy'), /Reading long\.csv/);
  // The forms are written meanwhile.
  assert.match(await copied('csv'), /^scene,index/);
  // What would help stays the same button.
  await page.fill('#min_gap', '5');
  const help = await page.$('#problem button');
  await page.evaluate(() => held[0][0].onmessage({ data: { progress: 0.5 } }));
  assert.match(await page.text('#busy'), /50 %/);
  assert.ok(await help.evaluate((it) => it.isConnected));
  const end = ended();
  await preset('leaf');
  assert.ok(!(await page.isSeen('#busy')));
  assert.match(await page.text('#problem'), /long\.csv.*stopped: another curve was chosen/);
  const shown = await curve();
  await end;
  assert.equal(await curve(), shown);
  await drop(['long.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  await drop(['bench.csv', trace()]);
  await page.evaluate(() => release());
  await fitted('bench.csv');
  assert.equal(await page.value('#name'), 'bench');
});

test('a number that is typed while a trace is read counts, though the reading began before', async () => {
  await open();
  await hold();
  await page.fill('#triggers', '1.5');
  await drop(['bench.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  await page.fill('#triggers', '13');
  await page.evaluate(() => release());
  await fitted('bench.csv');
  assert.equal(await page.value('#triggers'), '13');
  await page.says('The 13 times by the curve');
  await drop(['bounce.csv', bouncing()]);
  await fitted('bounce.csv');
  assert.equal((await ticks()).length, 13);
  await hold();
  await page.fill('#triggers', '9');
  await page.waitForSelector('#busy:not([hidden])');
  const end = ended();
  await page.fill('#triggers', '13');
  await end;
  assert.ok(!(await page.isSeen('#busy')));
  assert.equal((await ticks()).length, 13);
  assert.equal(await page.value('#triggers'), '13');
});

test('of files that are dropped together none vanishes without a word', async () => {
  await open();
  const shown = await curve();
  await drop(['mine.toml', 'open_start = 0'], ['bench.csv', trace()]);
  await page.says('opened alone: no file beside it was read');
  assert.ok(!(await page.isSeen('#speeds')));
  assert.equal(await curve(), shown);
});

test('a form that is refused is not offered, and what would help is', async () => {
  await open();
  await choose('pico');
  assert.match(await code(), /^There is nothing to copy yet.*delay/s);
  assert.ok((await page.isDisabled('#copy')) && (await page.isDisabled('#save')));
  await page.push('Give the sync’s delay');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'delay');
  await page.push('The sync is the opening: delay 0');
  await page.until(() => !document.getElementById('copy').disabled);
  assert.match(await copied('pico'), /^n 1\n/);
  await preset('strobe');
  await page.until(() => [...document.querySelectorAll('#code button')].some((it) => it.textContent.endsWith('delay 0')));
  await page.push('The sync is the opening: delay 0');
  await page.until(() => /up to 64 pulses/.test(document.getElementById('code').textContent));
  await page.push('Use 64 flashes');
  await page.until(() => !document.getElementById('copy').disabled);
  assert.match(await copied('pico'), /^n 64$/m);
});

test('what is wrong is told in the words and the unit of the page', async () => {
  await open();
  const told = async (name, changes, words) => {
    await preset(name);
    for (const [id, value] of Object.entries(changes)) await page.fill(`#${id}`, value);
    assert.match(await page.text('#problem'), words);
    assert.doesNotMatch(await page.text('#problem'), /`|\bticks?\b|trigger s/);
  };
  await told('projector', { pulse: '9' }, /^pulses of 9 ms: pulses 0 and 1 overlap by 0\.815 ms, and 2 ms is required; those of up to 0\.532 ms fit, or up to 5 flashes keep that/);
  await told('soft', { delay: '-1' }, /^sync delay: 0 or more is required; an edge cannot trigger what comes before it/);
  await told('soft', { timer_hz: '2.5' }, /^flashes 0 and 1 come 0 ms apart, and 400 ms is required; 1 flash keeps that/);
  await open();
  await drop(['bounce.csv', bouncing()]);
  await fitted('bounce.csv');
  await choose('pico');
  assert.match(await code(), /the scene has trigger times without one: .* fires what the form Rust makes of them/);
});

test('what holds a handle is told beside it, with what would help', async () => {
  await open();
  // Narrower, twelve flashes no longer keep the gap.
  await page.fill('#min_gap', '0.55');
  await page.blur('#min_gap');
  await drag('close_start', -200, 0);
  await page.until(() => !document.getElementById('hold').hidden);
  assert.match(await page.text('#hold'), /12 flashes would come closer than 0\.55 ms/);
  const held = await page.value('#close_start');
  assert.ok(held.length < 8, `a round number: ${held}`);
  await page.mouse.up();
  // What plays unasked leaves it there.
  await played();
  const [, n] = /Use (\d+) flash/.exec(await page.text('#hold'));
  await page.push(`Use ${n} flash${n === '1' ? '' : 'es'}`);
  assert.equal(await page.value('#triggers'), n);
  assert.ok(Number(await page.value('#close_start')) < Number(held));
  assert.ok(!(await page.isSeen('#hold')));
  assert.ok(!(await page.isDisabled('#copy')));
  await drag('t1', 0, 200);
  assert.match(await page.text('#hold'), /cannot go below/);
  await page.press('Escape');
  await page.mouse.up();
  assert.ok(!(await page.isSeen('#hold')));
});

test('the photograph follows the drag and the number of flashes, and is still where motion is not wanted', async () => {
  await open();
  await page.emulateMediaFeatures([{ name: 'prefers-reduced-motion', value: 'reduce' }]);
  await page.reload();
  await ready();
  const photos = () => page.$$eval('.photos canvas', (all) => all.map((it) => it.toDataURL()));
  const first = await photos();
  await played();
  assert.deepEqual(await photos(), first);
  await drag('close_start', -60, 0);
  const dragged = await photos();
  assert.ok(dragged.every((it, i) => it !== first[i]));
  await page.press('Escape');
  await page.mouse.up();
  await page.mouse.move(5, 5);
  await page.fill('#min_gap', '0');
  const slide = (value) => page.$eval('#flashes', (it, value) => {
    it.value = value;
    it.dispatchEvent(new Event('input', { bubbles: true }));
  }, value);
  const differ = async () => Number(/: ([\d.]+) % off/.exec(await page.text('#flash-caption'))?.[1] ?? 0);
  const seen = [];
  for (const [x, n] of [[0, 1], [3, 4], [15, 16], [35, 64], [55, 256]]) {
    await slide(x);
    assert.equal(await page.value('#triggers'), String(n));
    assert.equal((await ticks()).length, n);
    seen.push(await differ());
  }
  assert.ok(seen.every((x, i) => i === 0 || x < seen[i - 1] || x === 0), String(seen));
  assert.match(await page.text('#flash-caption'), /256 flashes.*hard to tell/);
});

test('several traces make a table of speeds, which prints, and a link that holds it', async () => {
  await open();
  await drop(['250.csv', trace({ open: 1.5 })], ['125.csv', trace({ open: 5.5 })], ['bounce.csv', bouncing()], ['diary.csv', 'dear diary\nnothing\n']);
  await page.waitForSelector('#speeds:not([hidden])');
  const table = () => page.$$eval('#speeds-table tbody tr', (all) => all.map((row) => [...row.children].map((it) => it.textContent)));
  const rows = await table();
  assert.deepEqual(rows.map((row) => row[0]), ['250.csv', 'bounce.csv', '125.csv', 'diary.csv']);
  assert.deepEqual([rows[0][2], rows[2][2]], ['1/250', '1/125']);
  assert.match(rows[0][1], /^(3\.99|4\.00)\d? ± [\d.e-]+ ms$/);
  const places = (number) => number.split('.')[1].length;
  for (const row of rows.slice(0, 3)) assert.equal(places(row[1].split(' ')[0]), places(row[1].split(' ')[2]), row[1]);
  assert.match(rows[1][5], /the trace itself/);
  assert.match(rows[3][5], /^not measured: .*no row of numbers in it/);
  const link = await copiedBy(() => page.click('#speeds-link'));
  // A row is a trace, which is shown.
  await page.push('125.csv');
  await fitted('125.csv');
  await open(link.slice(url.length));
  assert.deepEqual(await table(), rows);
  await page.click('#speeds-close');
  assert.ok(!(await page.isSeen('#speeds')));
});

test('on paper the curve is whole, with all ticks and no buttons', async () => {
  await open('', { width: 1440, height: 900 });
  await page.fill('#triggers', '18');
  await page.emulateMediaType('print');
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.resize(700, 900);
  const seen = await page.evaluate(() => ({
    buttons: [...document.querySelectorAll('button')].filter((it) => it.checkVisibility()).length,
    rows: document.querySelectorAll('#ticks tbody tr').length,
    cut: [...document.querySelectorAll('.scroll, #graph')].filter((it) => it.checkVisibility() && it.scrollHeight > it.clientHeight + 1).map((it) => it.id || it.ariaLabel),
    right: document.querySelector('#graph svg').getBoundingClientRect().right,
  }));
  assert.deepEqual({ ...seen, right: 0 }, { buttons: 0, rows: 18, cut: [], right: 0 });
  assert.ok(seen.right <= 700);
  assert.ok((await page.pdf({ format: 'a4' })).length > 10_000);
  const title = () => page.evaluate(() => getComputedStyle(document.querySelector('h1'), '::after').content);
  assert.equal(await title(), '": soft"');
  // What is in the way of a plan is told there as well, and no heading stands over nothing.
  await page.fill('#min_gap', '0.9');
  assert.ok(await page.isSeen('#problem'));
  assert.equal(await page.$eval('#bar', (it) => getComputedStyle(it).position), 'static');
  await page.fill('#min_gap', '0');
  await page.fill('#triggers', '200');
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  assert.ok(!(await page.isSeen('[data-panel=set-ups]')));
});

test('the table of ticks has the columns of the CSV, and fits at 1024', async () => {
  await open('', { width: 1024, height: 2800 });
  await preset('led');
  await page.fill('#delay', '1.5 ms');
  const names = await page.$$eval('#ticks th', (all) => all.map((it) => it.textContent));
  const [head, ...lines] = (await copied('csv')).trim().split('\n').map((line) => line.split(','));
  assert.deepEqual(head, ['scene', 'index', 'u', 'time_s', 'ticks', 'gap_ticks', 'from_edge_ticks', 'on_ticks', 'off_ticks']);
  // The scene's name stands above the table.
  assert.equal(names.length, head.length - 1);
  const cells = await page.$$eval('#ticks tbody tr', (all) => all.map((row) => [...row.children].map((it) => it.textContent)));
  for (const k of [3, 5, 6, 7]) assert.deepEqual(cells.map((row) => row[k]), lines.map((line) => line[k + 1]));
  assert.ok(await page.$eval('#ticks', (it) => it.scrollWidth <= it.closest('.scroll').clientWidth));
});

test('a frame leaves the host’s Back alone, fits 320 pixels and leads home', async () => {
  await open('#name=leaf&unit=ms&times=0,1.1,1.7,3&inner=0.1,0,0.2,1,0.6,1,0.9,0&triggers=8&timer_hz=1000000&min_gap=0', { width: 320, height: 640 }, '?embed');
  const before = await page.evaluate(() => history.length);
  for (const dx of [-10, 14, -8]) {
    await drag('open_end', dx, 0);
    await page.mouse.up();
    await settled();
  }
  assert.equal(await page.evaluate(() => history.length), before);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  assert.ok(await page.isSeen('#home'));
  const home = await page.$eval('#home', (it) => it.href);
  assert.match(home, /^[^?]*#name=leaf&/);
});

test('a finger reads the graph; at 320 pixels nothing overflows, nor with large letters', async () => {
  await open('', { width: 320, height: 2000, hasTouch: true });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  const { x, y, width, height } = await page.box('#graph');
  await page.touchscreen.tap(x + width / 2, y + height / 3);
  assert.match(await page.text('#readout'), /% open · .*% collected · flash \d+: tick \d+$/);
  // No word is cut, nor what holds a handle.
  await page.fill('#delay', '123.5');
  await page.fill('#min_gap', '0.55');
  await drag('close_start', -60, 0);
  await page.mouse.up();
  assert.ok(await page.isSeen('#hold'));
  const cut = await page.$$eval('#readout, #facts dd, #hold', (all) => all.filter((it) => it.scrollWidth > it.clientWidth || it.scrollHeight > it.clientHeight + 1).map((it) => it.textContent));
  assert.deepEqual(cut, []);
  const [box, hold] = [await page.box('#graph'), await page.box('#hold')];
  assert.ok(hold.x >= box.x && hold.x + hold.width <= box.x + box.width && hold.y + hold.height <= box.y + box.height, JSON.stringify([box, hold]));
  await page.resize(640, 2000);
  await page.evaluate(() => (document.documentElement.style.fontSize = '200%'));
  await drawn();
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 640);
  assert.ok((await page.$eval('#copy', (it) => Number.parseFloat(getComputedStyle(it).fontSize))) >= 28, 'letters grow');
});

test('Copy is at most twelve stops of Tab away, and what is loaded moves nothing', async () => {
  await page?.close();
  const fresh = extend(await browser.newPage());
  await fresh.evaluateOnNewDocument(() => {
    globalThis.shift = 0;
    new PerformanceObserver((list) => list.getEntries().forEach(({ value }) => (shift += value))).observe({ type: 'layout-shift', buffered: true });
  });
  for (const [width, height] of [[1440, 900], [390, 844]]) {
    await fresh.setViewport({ width, height });
    await fresh.goto('about:blank');
    await fresh.goto(url);
    await ready(fresh);
    // The last to come is what plays.
    await fresh.until(() => document.querySelector('path.cross').getAttribute('d') && !document.getElementById('code').classList.contains('waits'));
    await drawn(fresh);
    const shift = await fresh.evaluate(() => globalThis.shift);
    assert.ok(shift < 0.05, `${width}: ${shift}`);
    let stops = 0;
    for (; (await fresh.evaluate(() => document.activeElement.id)) !== 'copy' && stops < 40; stops++) {
      await fresh.press('Tab');
      if (await fresh.evaluate(() => document.activeElement.hash === '#copy')) await fresh.press('Enter');
    }
    assert.ok(stops <= 12, `${width}: ${stops}`);
  }
  await fresh.close();
});

test('what is in focus and where one types can be told: 3:1', async () => {
  await open();
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: colorScheme }]);
    await page.focus('#handle-open_end');
    await page.press('ArrowRight');
    const found = await page.evaluate(() => {
      const light = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map((x) => x / 255).map((x) => (x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)).reduce((sum, x, i) => sum + x * [0.2126, 0.7152, 0.0722][i], 0);
      const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
      const card = getComputedStyle(document.querySelector('.card')).backgroundColor;
      const halo = getComputedStyle(document.querySelector('#handle-open_end .halo'));
      return [contrast(halo.stroke, card) * Number(halo.opacity), contrast(getComputedStyle(document.getElementById('name')).borderColor, card), contrast(getComputedStyle(document.getElementById('unit')).borderColor, card)];
    });
    assert.ok(found.every((x) => x >= 3), `${colorScheme}: ${found}`);
  }
});
