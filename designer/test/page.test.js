// The page beside the program `shutter` on the same scenes: in Chromium.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { connect } from 'node:net';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { ROOT, SCENES, SOFT, bouncing, browser, choose, clipped, complaints, copied, copiedBy, curve, drag, drawn, drop, ended, extend, fitted, forgive, hold, middle, open, page, planned, preset,
  ready, refused, saved, scratch, setUp, settled, shutter, ticks, trace, url, written } from './harness.js';

// Everything within one ramp or the other: the most that a curve can ask of the crate.
const ALL_RAMP = '#name=ramps&unit=ms&times=0,5,5,10&inner=0.2,0,0.3,1,0.7,1,0.8,0&triggers=256&timer_hz=10000000&min_gap=0';

setUp();

test('the first screen takes at most 90 kB, compressed', async () => {
  await open('', { width: 1440, height: 900 });
  const first = await page.evaluate(() => {
    const [{ startTime }] = performance.getEntriesByName('ready');
    return ['/', ...new Set(performance.getEntriesByType('resource').filter((it) => it.startTime < startTime).map((it) => new URL(it.name).pathname))];
  });
  assert.ok(first.length >= 4, String(first));
  const size = (path) => gzipSync(readFileSync(join(ROOT, 'designer', 'dist', path === '/' ? 'index.html' : path)), { level: 9 }).length;
  const sum = first.reduce((sum, path) => sum + size(path), 0);
  console.log(`first screen: ${first.length} files, ${(sum / 1000).toFixed(1)} kB by gzip, of which engine.wasm ${(size(first.find((path) => path.endsWith('engine.wasm'))) / 1000).toFixed(1)}`);
  assert.ok(sum <= 90_000, String(sum));
});

test('every preset has the bits that the program has', async () => {
  await open();
  for (const name of ['leaf', 'trapezoid', 'box', 'liquid-crystal']) {
    await preset(name);
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
  assert.ok(Number(await page.value('#open_end')) > 3);
  assert.ok(Number(await page.value('#y2')) < 0.9);
});

test('wrong numbers stay as they are typed, with the reason', async () => {
  await open();
  const before = await curve();
  for (const [id, text, message] of [
    ['t1', '2', /opening ramp: the time of its first inner point has to lie on the ramp, .* 0 at the start, 1 at the end; it is 2/],
    ['y6', '-1', /closing ramp: the openness of its second inner point has to be in \[0, 1\]; it is -1/],
    ['open_end', 'NaN', /“NaN” is no number/],
    ['close_end', '1e400', /^is closed: a finite number is required/],
    ['close_start', '-4', /times out of order/],
    ['triggers', '1.5', /“1.5” is no whole number/],
    ['triggers', '0', /^how many: a whole number from 1 to 10000 is required/],
    ['triggers', '99999999999', /^how many: a whole number/],
    ['timer_hz', '', /^timer, Hz: a number is required/],
    ['min_gap', '-1', /^least gap: 0 or more is required/],
    ['min_gap', '5', /flashes 0 and 1 come .* apart/],
    ['nominal', 'x', /“x” is no number/],
    ['timer_bits', '24', /^timer, bits: 16 or 32 is required/],
  ]) {
    const last = await page.value(`#${id}`);
    await page.fill(`#${id}`, text);
    assert.match(await page.text('#problem'), message, `${id} ${text}`);
    assert.equal(await page.value(`#${id}`), text);
    // Triggers that come too close are told where their number is.
    const place = text === '5' ? 'triggers' : id;
    assert.equal(await page.attribute(`#${place}`, 'aria-invalid'), 'true', id);
    assert.ok(await page.isDisabled('#copy'));
    assert.equal(await curve(), before);
    await page.fill(`#${id}`, last);
    assert.ok(!(await page.isSeen('#problem')), id);
  }
});

/** All that a person sees of the scene, to the bit. */
const seen = () => page.evaluate(() => ({
  numbers: [...document.querySelectorAll('#numbers input, #numbers select')].map((it) => [it.id, it.type === 'checkbox' ? it.checked : it.value]),
  curve: document.querySelector('#graph path.curve').getAttribute('d'),
  handles: [...document.querySelectorAll('g.handle')].map((it) => it.getAttribute('transform')),
  pressed: [...document.querySelectorAll('[aria-pressed=true]')].map((it) => it.dataset.name),
  other: document.querySelector('#graph path.other').getAttribute('d'),
  link: document.getElementById('link').disabled,
}));

test('Back and Forward, the buttons and the keys go the same steps', async () => {
  await open();
  const seen = () => page.evaluate(() => designer.hash(designer.model.now));
  const states = [await seen()];
  const done = async () => {
    await settled();
    states.push(await seen());
  };
  await preset('leaf');
  await done();
  await drag('open_end', 20, 0);
  await page.mouse.up();
  await done();
  await page.fill('#triggers', '7');
  await page.blur('#triggers');
  await done();
  await page.fill('#unit', 's');
  await done();
  for (const k of [3, 2]) {
    await page.goBack();
    await settled();
    assert.deepEqual(await seen(), states[k], `back to ${k}`);
  }
  await page.click('#undo');
  assert.deepEqual(await seen(), states[1]);
  await page.press('Control+y');
  assert.deepEqual(await seen(), states[2]);
  await settled();
  await page.goForward();
  await settled();
  assert.deepEqual(await seen(), states[3]);
  await page.press('Control+Shift+Z');
  assert.deepEqual(await seen(), states[4]);
  await settled();
  // What is undone and done otherwise cannot be redone; a key in a field undoes the same steps, and stays there.
  await page.focus('#triggers');
  await page.press('Control+z');
  assert.deepEqual(await seen(), states[3]);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'triggers');
  await page.fill('#triggers', '6');
  assert.ok(await page.isDisabled('#redo'));
  // A link that somebody types into this page is a step as well.
  await page.until(() => location.hash.includes('triggers=6'));
  await page.evaluate(() => (location.hash = location.hash.replace('triggers=6', 'triggers=5')));
  await page.until(() => document.getElementById('triggers').value === '5');
  await page.click('#undo');
  assert.equal(await page.value('#triggers'), '6');
});

test('nothing is lost by looking', async () => {
  await open();
  await page.fill('#open_end', '5');
  assert.deepEqual([await page.value('#t1'), await page.value('#t2'), await page.value('#t5')], ['0.2', '0.3', '0.85'], 'a time takes its ramp along');
  await page.click('#undo');
  await page.fill('#t1', '0.07');
  await page.fill('#straight', true);
  assert.notEqual(await page.value('#t1'), '0.07');
  await page.fill('#straight', false);
  assert.equal(await page.value('#t1'), '0.07');
  await page.fill('#lamp', 'duty');
  await page.fill('#duty', '0.21');
  await page.fill('#min_pulse', '0.01');
  await page.fill('#lamp', 'pulse');
  await page.fill('#pulse', '0.0625');
  await page.fill('#lamp', '');
  await page.fill('#unit', 'µs');
  await page.fill('#lamp', 'pulse');
  assert.equal(await page.value('#pulse'), '62.5');
  await page.fill('#lamp', 'duty');
  assert.deepEqual([await page.value('#duty'), await page.value('#min_pulse')], ['0.21', '10']);
});

test('numbers are read as people write them, and a separator of thousands is refused', async () => {
  await open();
  for (const [id, text, value, echo] of [
    ['min_gap', '0,25', 0.25, '= 0.25'], ['min_gap', '0.125', 0.125, ''], ['min_gap', '0,125', 0.125, '= 0.125'], ['open_start', '−0,5', -0.5, '= -0.5'],
    ['open_start', '-.5e0', -0.5, '= -0.5'], ['timer_hz', '1e6', 1_000_000, '= 1000000'], ['min_gap', '0', 0, ''],
    ['nominal', '1/125', 8, '= 8'], ['nominal', '1/125 s', 8, '= 8'], ['timer_hz', '1 MHz', 1_000_000, '= 1000000'], ['timer_hz', '2,5 kHz', 2500, '= 2500'], ['open_end', '2.5 ms', 2.5, '= 2.5'],
    ['open_end', '2400µs', 2.4, '= 2.4'], ['min_gap', '5e4 ns', 0.05, '= 0.05'],
  ]) {
    await page.fill(`#${id}`, text);
    assert.ok(!(await page.isSeen('#problem')), `${text}: ${await page.text('#problem')}`);
    assert.equal(await page.text('#echo'), echo, text);
    const toml = await copied('toml');
    assert.equal(Number(toml.match(new RegExp(`^${id} = (.*)$`, 'm'))[1]), value, text);
    await page.blur(`#${id}`);
  }
  const before = await copied('toml');
  for (const [id, text, words] of [
    ['min_gap', '1,500', '“1,500” may be 1.5 or 1500'], ['timer_hz', '1.000', '“1.000” may be 1 or 1000'], ['min_gap', '1.000,5', 'write 1000.5'],
    ['timer_hz', '1,000,000', 'write 1000000'], ['timer_hz', '1 500', 'write 1500'], ['timer_hz', '1\u202f500', 'write 1500'], ['open_end', '12’000', 'write 12000'],
    ['open_end', '1,234.5', 'write 1234.5'], ['open_end', '2 kHz', 'has an unknown unit'], ['open_end', '1/2/3', 'is no number'], ['timer_hz', '1 ms', 'has an unknown unit'],
  ]) {
    const was = await page.value(`#${id}`);
    await page.fill(`#${id}`, text);
    assert.ok((await page.text('#problem')).includes(words), `${text}: ${await page.text('#problem')}`);
    assert.equal(await page.attribute(`#${id}`, 'aria-invalid'), 'true');
    assert.ok(await page.isDisabled('#copy'));
    assert.ok(await page.isDisabled('#link'));
    await page.fill(`#${id}`, was);
  }
  assert.equal(await copied('toml'), before);
});

test('at 1024 pixels no number is cut, nor one of the ticks at 320', async () => {
  await open('#name=long&unit=µs&times=-1234.5678,1262.68902,4671.17877,8710.60274&inner=0.1227014,0.0005208,0.1941086,0.9329666,0.75,0.91,0.87,0.001&triggers=10000&timer_hz=4294967295&min_gap=0.0012345&nominal=12345.678&pulse=0.012345&delay=123456.78'.replace('4294967295', '100000000'), { width: 1024, height: 2800 });
  await page.$eval('#inner', (it) => (it.open = true));
  const cut = await page.$$eval('#numbers input:not([type])', (all) => all.filter((it) => it.offsetWidth && it.scrollWidth > it.clientWidth).map((it) => `${it.id} ${it.value}`));
  assert.deepEqual(cut, []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 1024);
  for (const width of [1024, 320]) {
    await page.resize(width, 5000);
    assert.deepEqual(await page.$$eval('#ticks :is(th, td)', (all) => all.filter((it) => it.scrollWidth > it.clientWidth).map((it) => it.textContent)), [], String(width));
  }
});

test('handles in one place can each be taken', async () => {
  await open('#name=triangle&unit=ms&times=0,50,50,100&triggers=20&timer_hz=1000000&min_gap=2');
  assert.equal(await page.value('#open_end'), await page.value('#close_start'));
  // A triangle opens into a trapezoid, to either side.
  await drag('open_end', -60, 0);
  await page.mouse.up();
  assert.ok(Number(await page.value('#open_end')) < 45, await page.value('#open_end'));
  assert.equal(await page.value('#close_start'), '50');
  await page.click('#undo');
  await drag('open_end', 60, 0);
  await page.mouse.up();
  assert.ok(Number(await page.value('#close_start')) > 55);
  assert.equal(await page.value('#open_end'), '50');
});

test('what is under the pointer is read out', async () => {
  await open();
  const [x, y] = await middle('open_end');
  await page.mouse.move(x, y + 40);
  assert.match(await page.text('#readout'), /^2\.5\d* ms · (100|99\.\d+) % open · 1[67](\.\d+)? % collected · flash 2: tick \d+$/);
  const { x: left, width } = await page.box('#graph');
  await page.mouse.move(left + width / 2 + 14, y + 40);
  assert.match(await page.text('#readout'), /^(4\.9|5\.0)\d* ms · 100 % open · (49|50)/);
  await page.mouse.move(5, 5);
  assert.equal(await page.text('#readout'), '');
});

test('keys move a handle as a slider, with a range', async () => {
  await open();
  await page.focus('#handle-open_end');
  const at = (name) => page.evaluate((name) => ['min', 'now', 'max'].map((part) => Number(document.getElementById(`handle-${name}`).getAttribute(`aria-value${part}`))), name);
  assert.deepEqual(await at('open_end'), [0, 2.5, 7.5]);
  await page.keyboard.press('End');
  assert.deepEqual(await at('open_end'), [0, 7.5, 7.5]);
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await at('open_end'), [0, 7.5, 7.5]);
  await page.keyboard.press('Home');
  assert.deepEqual(await at('open_end'), [0, 0, 7.5]);
  await page.keyboard.press('PageUp');
  assert.deepEqual(await at('open_end'), [0, 1, 7.5]);
  await page.keyboard.press('PageDown');
  assert.deepEqual(await at('open_end'), [0, 0, 7.5]);
  assert.match(await page.text('#readout'), /^0(\.0+)? ms/);
  for (const name of ['open_start', 't1', 't2', 't5', 't6', 'close_end']) {
    await page.focus(`#handle-${name}`);
    for (const key of ['End', 'Home', 'PageUp', 'ArrowUp', 'ArrowDown', 'Shift+ArrowLeft']) await page.press(key);
    const [min, now, max] = await at(name);
    assert.ok(min <= now && now <= max && min < max, `${name}: ${[min, now, max]}`);
    assert.ok(!(await page.isSeen('#problem')));
  }
});

test('each copied form compiles or parses', async () => {
  await open();
  const crate = join(scratch, 'crate');
  execFileSync('mkdir', ['-p', join(crate, 'src')]);
  writeFileSync(join(crate, 'Cargo.toml'), `[package]\nname="copied"\nedition="2024"\n[dependencies]\nshutter-curve={path=${JSON.stringify(ROOT)}}\n[workspace]\n`);
  let lib = '';
  for (const name of ['leaf', 'box', 'trapezoid', 'liquid-crystal']) {
    await preset(name);
    assert.equal(await copied('rust'), await planned('rust', name));
    writeFileSync(join(crate, 'src', `of_${name.replace('-', '_')}.rs`), await copied('rust'));
    lib += `pub mod of_${name.replace('-', '_')};\n`;
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

test('the keyboard alone gets from a preset to a copied static', async () => {
  await open('');
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.dataset.name);
  const tabTo = async (id) => {
    for (let i = 0; i < 80; i++) {
      if ((await focused()) === id) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`no way to ${id}`);
  };
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.hash), '#handle-open_start');
  await tabTo('file');
  await tabTo('leaf');
  await page.press('End');
  await page.press('ArrowLeft');
  assert.equal(await focused(), 'liquid-crystal');
  await page.press('Home');
  assert.equal(await focused(), 'leaf');
  await page.press('Enter');
  await tabTo('handle-t1');
  const before = await page.value('#t1');
  await page.keyboard.press('ArrowRight');
  assert.equal(Number(await page.value('#t1')), Number(before) + 0.01);
  await page.press('Shift+ArrowUp');
  assert.equal(await page.value('#y1'), '0.001');
  await page.keyboard.press('ArrowDown');
  assert.equal(await page.value('#y1'), '0', 'not below');
  assert.ok(!(await page.isSeen('#problem')));
  for (const name of ['open_start', 'open_end', 'close_start', 'close_end', 't1', 't2', 't5', 't6']) {
    assert.ok(await page.attribute(`#handle-${name}`, 'aria-label'));
    assert.match(await page.attribute(`#handle-${name}`, 'aria-valuetext'), /\d/);
  }
  await tabTo('copy');
  await page.keyboard.press('Enter');
  await page.until(() => /Copied/.test(document.getElementById('told').textContent));
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /pub static SHUTTER: ShutterCurve = valid\(/);
  await tabTo('form-rust');
  await page.keyboard.press('ArrowRight');
  assert.equal(await focused(), 'form-c');
  // Every control has a name.
  const nameless = await page.$$eval('input, select, button', (all) => all.filter((it) => !(it.labels?.length || it.textContent.trim() || it.ariaLabel)).map((it) => it.id));
  assert.deepEqual(nameless, []);
});

test('on a phone nothing overflows, and a finger drags', async () => {
  await open(SOFT, { width: 390, height: 844, hasTouch: true });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  for (const id of ['begin', 'graph']) assert.ok((await page.box(`#${id}`)).y < 600, 'the way in is on the first screen');
  const [x, y] = await middle('t1');
  const session = await page.createCDPSession();
  const touch = (type, ...touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
  await touch('touchStart', { x, y });
  for (let i = 1; i <= 5; i++) await touch('touchMove', { x: x + 2 * i, y: y - 8 * i });
  await touch('touchEnd');
  assert.ok(Number(await page.value('#y1')) > 0.1, await page.value('#y1'));
  assert.ok(Number(await page.value('#t1')) > 0.1);
});

test('a move writes nothing that is not seen', async () => {
  await open(ALL_RAMP, { width: 1360, height: 900 });
  // It was seen, and is no longer.
  await page.$eval('#ticks', (it) => it.scrollIntoView());
  await page.until(() => document.querySelectorAll('#ticks tbody tr').length === 256);
  await page.evaluate(() => scrollTo(0, 0));
  await drawn();
  const [x, y] = await middle('t2');
  await page.mouse.move(x, y);
  await page.mouse.down();
  // What it costs is printed; what it writes is what the test holds, on a machine that may be busy.
  const session = await page.createCDPSession();
  await session.send('Performance.enable');
  const spent = async () => {
    const { metrics } = await session.send('Performance.getMetrics');
    return ['ScriptDuration', 'LayoutDuration', 'RecalcStyleDuration'].map((name) => 1000 * metrics.find((metric) => metric.name === name).value);
  };
  const moves = [];
  for (let i = 1; i <= 30; i++) {
    const start = await spent();
    await page.mouse.move(x - 2 * i, y + i);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    moves.push((await spent()).map((ms, k) => ms - start[k]).reduce((sum, ms) => sum + ms));
  }
  moves.sort((a, b) => a - b);
  console.log(`a move with 256 triggers on all ramp: ${moves[15].toFixed(2)} ms of the main thread (median; 0.6 of a frame is 10), ${moves[3].toFixed(2)} ms the tenth quickest of a hundred`);
  await page.evaluate(() => {
    globalThis.writes = {};
    new MutationObserver((list) => {
      for (const { target } of list) {
        const id = (target.closest ? target : target.parentElement)?.closest('[id]')?.id ?? 'none';
        writes[id] = (writes[id] ?? 0) + 1;
      }
    }).observe(document.body, { subtree: true, childList: true, characterData: true, attributes: true });
  });
  const before = await curve();
  for (let i = 1; i <= 10; i++) await page.mouse.move(x - 3 * i, y + i);
  assert.notEqual(await curve(), before);
  const writes = await page.evaluate(() => writes);
  await page.mouse.up();
  for (const id of ['ticks', 'ticks-note']) assert.equal(writes[id] ?? 0, 0, `${id}: ${JSON.stringify(writes)}`);
  const most = Object.values(writes).reduce((sum, n) => sum + n, 0) / 10;
  console.log(`${most} writes a move`);
  assert.ok(most < 150, JSON.stringify(writes));
  // Once it is seen it is written.
  const asked = JSON.parse(await copied('json')).triggers.map((trigger) => trigger.ticks);
  await page.$eval('#ticks', (it) => it.scrollIntoView());
  await page.until((last) => document.querySelector('#ticks tbody tr:last-child').children[3].textContent === last, String(asked.at(-1)));
  assert.deepEqual(await ticks(), asked);
});

test('a fit leaves what is not of the shutter, and is a step; what is wrong with a trace can be mended where it is told', async () => {
  await open();
  const value = (id) => page.value(`#${id}`);
  const trace = () => page.attribute('#graph path.trace', 'd');
  const choice = (name, value) => page.fill(`#trace [name=${name}]`, value);
  const told = () => page.text('.facts');
  const select = async (...it) => {
    await choice(...it);
    await page.until(() => document.getElementById('busy').hidden);
  };
  const rows = (unit, value, header = '') => header + Array.from({ length: 800 }, (_, i) => {
    const f = i < 200 || i > 560 ? 0 : i < 280 ? (i - 200) / 80 : i < 440 ? 1 : (560 - i) / 120;
    return [...(unit ? [(i * unit).toPrecision(6)] : []), value(f + 0.01 * Math.sin(i * i)).toFixed(4)].join(',');
  }).join('\n');
  await page.fill('#unit', 'ms');
  await page.fill('#lamp', 'pulse');
  await page.fill('#pulse', '0.011');
  await page.fill('#min_gap', '0.02');
  await page.blur('#min_gap');
  const before = await page.evaluate(() => designer.hash(designer.model.now));
  // Times without a unit: seconds, until somebody says otherwise.
  await drop(['bench.csv', rows(0.01, (f) => 0.1 + 2 * f, 't,v\n')]);
  await fitted('bench.csv');
  assert.match(await page.text('#facts .doubt'), /does not say in which unit/);
  assert.deepEqual(await page.$$eval('#trace .preview tr', (all) => all.slice(0, 3).map((row) => [...row.children].map((it) => it.textContent))),
    [['line', 't time', 'v light'], ['2', '0.00000', '0.1000'], ['3', '0.0100000', '0.1168']]);
  assert.ok(Math.abs(Number(await value('open_end')) - 800) < 5, await value('open_end'));
  await page.push('Choose the unit');
  assert.equal(await page.evaluate(() => document.activeElement.name), 'unit');
  await select('unit', 'ms');
  await page.until(() => Math.abs(document.getElementById('open_end').value - 0.8) < 0.01);
  assert.ok(!/does not say/.test(await told()));
  assert.deepEqual([await value('pulse'), await value('min_gap'), await value('triggers'), await value('lamp'), await value('name')], ['0.011', '0.02', '12', 'pulse', 'bench']);
  assert.match(await page.text('#speed'), /^1\/\d+ s$/);
  // Each is a step; with the first the trace goes as well.
  await page.click('#undo');
  assert.ok(Number(await value('open_end')) > 700);
  await page.click('#undo');
  assert.equal(await page.evaluate(() => designer.hash(designer.model.now)), before);
  assert.equal(await trace(), '');
  assert.match(await page.text('#trace'), /Open or drop the CSV/);
  await page.click('#redo');
  await page.until(() => designer.model.now.trace && !designer.model.pending);
  assert.ok((await trace()).length > 1000);
  // A second file that is none: the first one's trace is said to stay, and can be removed.
  await drop(['notes.csv', 'dear diary,\nnothing happened\n']);
  await page.waitForSelector('#trace .wrong');
  assert.match(await page.text('#trace'), /notes\.csv.*no CSV.*The trace of bench\.csv stays/s);
  assert.ok((await trace()).length > 1000);
  await page.push('Remove the trace');
  assert.equal(await trace(), '');
  // No times: the rate mends it.
  await drop(['one.csv', rows(0, (f) => 0.1 + 2 * f)]);
  await page.waitForSelector('#trace .wrong');
  await page.push('Give the rate');
  assert.equal(await page.evaluate(() => document.activeElement.name), 'rate');
  await page.keyboard.type('100,5e3');
  await page.keyboard.press('Enter');
  await page.until(() => designer.model.now.trace && !designer.model.pending);
  assert.ok(Math.abs(Number(await value('open_end')) - (80 / 100.5)) < 0.01, await value('open_end'));
  // Light that lowers the signal; asked to raise it, there is no dark to begin with, and that is mended as well.
  await drop(['down.csv', rows(1e-5, (f) => 3 - 2 * f, 'time (s),dark,light\n').replace(/,(?=[\d.]+$)/gm, ',0.5,')]);
  await fitted('down.csv');
  assert.match(await page.text('#trace [name=rises] option'), /falls/);
  await select('rises', 'true');
  await page.waitForSelector('#trace .wrong');
  await page.push('Say which way');
  await select('rises', 'false');
  await page.until(() => designer.model.now.trace && !designer.model.pending);
  // A column without a pulse, chosen before the other choice is read.
  await hold();
  await choice('rises', '');
  await choice('signal', '2');
  await page.evaluate(() => release());
  await page.waitForSelector('#trace .wrong');
  assert.doesNotMatch(await page.text('main'), /--[a-z]|shutter fit/);
  await page.push('Choose the columns');
  await select('signal', '3');
  await page.until(() => designer.model.now.trace && !designer.model.pending);
  // A preset is another shutter.
  await preset('leaf');
  assert.equal(await trace(), '');
  await drop(['notes.csv', 'dear diary,\nnothing happened\n']);
  await page.waitForSelector('#trace .wrong');
  await preset('box');
  await page.waitForSelector('#trace .wrong', { hidden: true });
});

test('a dropped scene is opened, and a broken one refused with its line', async () => {
  await open();
  await drop(['mine.toml', readFileSync(join(SCENES, 'trapezoid.toml'), 'utf8')]);
  await page.until(() => document.getElementById('name').value === 'mine');
  const { length } = await ticks();
  await drop(['mine.toml', 'open_start = 0\nopen_end = "soon"\n']);
  await page.waitForSelector('#problem.wrong');
  assert.match(await page.text('#problem'), /^mine\.toml:2: open_end: a number is required/);
  assert.equal(await page.value('#name'), 'mine');
  assert.equal((await ticks()).length, length);
});

test('broken and huge traces get a message, and the page goes on', async () => {
  await open();
  const before = await copied('json');
  const refused = async (message) => {
    await page.waitForSelector('#problem.wrong:not([hidden])');
    assert.match(await page.text('#problem'), message);
    await page.push('Close');
    assert.ok(!(await page.isSeen('#problem')));
  };
  for (const [text, message] of [
    ['', /empty/],
    ['\0\u0001\u0002PNG', /binary/],
    ['<html><body>not found</body></html>', /no CSV/],
    ['time,volt\n0,1\n1,1\n', /gives a rate/],
    ['t,v\n' + 'nan,nan\n'.repeat(1000), /./],
    ['t,v\n' + '1e308,-1e308\n'.repeat(1000), /./],
    ['t,v\n' + Array.from({ length: 2000 }, (_, i) => `${i}e-5,1`).join('\n'), /no pulse|sample/],
  ]) {
    await drop(['broken.csv', text]);
    await refused(message);
  }
  // 50 MB: of no numbers, and of numbers without a pulse.
  await drop(['huge.csv', () => 'volt;garbage;;;'.repeat(3_500_000)]);
  await refused(/pulse|row of numbers|line/);
  await drop(['huge.csv', () => Array.from({ length: 50 }, (_, k) => Array.from({ length: 60_000 }, (_, i) => `${(k * 60_000 + i)}e-6,0.${100000 + ((i * 7919) % 1000)}`).join('\n')).join('\n')]);
  // Meanwhile the page works.
  await page.fill('#triggers', '13');
  assert.equal((await ticks()).length, 13);
  await page.fill('#triggers', '12');
  await refused(/pulse|row of numbers|line/);
  await drop(['huge.csv', () => new Uint8Array(300 << 20)]);
  await refused(/300 MB: cut the trace/);
  assert.equal(await copied('json'), before);
});

test('a fit is stopped', async () => {
  await open();
  await drop(['long.csv', () => Array.from({ length: 50 }, (_, k) => Array.from({ length: 60_000 }, (_, i) => `${(k * 60_000 + i)}e-6,0.${100000 + ((i * 7919) % 1000)}`).join('\n')).join('\n')]);
  await page.waitForSelector('#busy:not([hidden])');
  await page.push('Stop');
  await page.until(() => !document.getElementById('problem').hidden);
  assert.match(await page.text('#problem'), /stopped/);
  assert.ok(!(await page.isSeen('#busy')));
  assert.match(await copied('rust'), /static SHUTTER/, 'the next question is answered');
});

test('links of garbage get a message', async () => {
  const garbage = ['#%', '#%E0%A4%A', '#<script>alert(1)</script>', '#times=1', '#times=0,1,2,3', '#' + 'a'.repeat(100_000), '#times=,,,&triggers=&timer_hz=&min_gap=',
    ALL_RAMP.replace('unit=ms', 'unit=parsec'), ALL_RAMP.replaceAll(/=[\d.,]+/g, '=NaN'), ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, 'NaN'),
    ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, '1e308'), ALL_RAMP.replaceAll(/\d+(\.\d+)?/g, '-Infinity'), ALL_RAMP.replace('triggers=256', 'triggers=4294967295')];
  for (const [i, hash] of garbage.entries()) {
    // As the page's first address, or typed into it.
    if (i % 4 === 0) await open(hash);
    else await page.evaluate((hash) => (location.hash = hash), hash);
    await page.waitForSelector('#problem:not([hidden])');
    assert.ok(await page.isSeen('#problem'), hash.slice(0, 80));
    assert.ok((await page.text('#problem')).length > 10, hash.slice(0, 80));
    // Nothing but the link's own curve is shown.
    if (await page.isSeen('#graph svg')) assert.match(await curve(), /^M[\d .,LCHVM-]+$/, hash.slice(0, 80));
    else assert.ok(!(await page.isSeen('#code')) && (await page.isDisabled('#link')));
    assert.ok(await page.isDisabled('#copy'));
    // A preset leads out of it.
    await preset('leaf');
    assert.ok(!(await page.isSeen('#problem')));
    assert.equal((await ticks()).length, 6);
    assert.deepEqual(complaints, []);
    if (i % 4 === 3) await page.close();
  }
});

test('the most triggers are shown without a hang', async () => {
  await open(ALL_RAMP.replace('triggers=256', 'triggers=10000'));
  assert.equal((await ticks()).length, 300);
  assert.equal(JSON.parse(await copied('json')).triggers.length, 10_000);
  assert.match(await page.text('#ticks-note'), /9700/);
});

test('a link that holds no curve does not show the shutter before', async () => {
  await open();
  assert.ok(await page.isSeen('#graph svg'));
  await page.evaluate(() => (location.hash = '#times=1'));
  await page.waitForSelector('body.void');
  assert.equal(await page.$$eval('main > *', (all) => all.filter((it) => it.checkVisibility()).map((it) => it.id).join()), 'begin');
  assert.equal(await page.count('[aria-pressed=true]'), 0);
  assert.match(await page.text('#problem'), /^The link holds no curve: times: 4 numbers are required/);
  assert.ok(await page.isDisabled('#link'));
  await page.push('Go on without it');
  assert.ok(await page.isSeen('#graph svg'));
  assert.equal(await page.value('#name'), 'soft');
});

const AXE = readFileSync(join(import.meta.dirname, '..', 'node_modules', 'axe-core', 'axe.min.js'), 'utf8');

test('axe finds nothing: plain, wrong, with a trace, with doses, narrow, each in light and dark', async () => {
  await open();
  await page.evaluate(AXE);
  const faults = () => page.evaluate(async () => {
    const { violations } = await axe.run(document, { resultTypes: ['violations'] });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target} ${failureSummary.replace(/\s+/g, ' ').slice(0, 160)}`));
  });
  const states = {
    plain: async () => {},
    doses: async () => {
      await page.fill('#min_gap', '0');
      await page.fill('#lamp', 'duty');
    },
    wrong: () => page.fill('#close_start', '-4'),
    trace: async () => {
      await page.click('#undo');
      await preset('measured');
      await fitted('leaf.csv');
      await page.$$eval('#trace details', (all) => all.forEach((it) => (it.open = true)));
    },
    refused: async () => {
      await drop(['one.csv', refused()]);
      await page.waitForSelector('#trace .wrong');
    },
    speeds: async () => {
      await drop(['a.csv', clipped()], ['b.csv', trace()]);
      await page.waitForSelector('#speeds:not([hidden])');
    },
    narrow: () => page.resize(390, 2800),
  };
  for (const [name, enter] of Object.entries(states)) {
    await enter();
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: colorScheme }]);
      assert.deepEqual(await faults(), [], `${name}, ${colorScheme}`);
    }
  }
});

test('every button can be read in every state', async () => {
  await open();
  await preset('leaf');
  const session = await page.createCDPSession();
  await session.send('DOM.enable');
  await session.send('CSS.enable');
  const { root } = await session.send('DOM.getDocument');
  const { nodeIds } = await session.send('DOM.querySelectorAll', { nodeId: root.nodeId, selector: 'button, .button, a' });
  assert.ok(nodeIds.length > 15);
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: colorScheme }]);
    for (const state of ['', 'hover', 'focus', 'active', 'focus-visible']) {
      for (const nodeId of nodeIds) await session.send('CSS.forcePseudoState', { nodeId, forcedPseudoClasses: state ? [state, 'hover'] : [] });
      const poor = await page.$$eval('button, .button, a, button b, button small', (all) => all.filter((it) => it.offsetWidth).map((it) => {
        const numbers = (colour) => colour.match(/[\d.]+/g).map(Number);
        const light = (colour) => numbers(colour).slice(0, 3).map((x) => x / 255).map((x) => (x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)).reduce((sum, x, i) => sum + x * [0.2126, 0.7152, 0.0722][i], 0);
        let under = it;
        while (numbers(getComputedStyle(under).backgroundColor)[3] === 0) under = under.parentElement;
        const [a, b] = [getComputedStyle(it).color, getComputedStyle(under).backgroundColor].map(light);
        return [it.id || it.textContent, (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05)];
      }).filter(([, contrast]) => contrast < 4.5));
      assert.deepEqual(poor, [], `${colorScheme}, ${state}`);
    }
  }
});

test('in forced colours the chosen tab and the pressed preset can be told', async () => {
  await open('');
  await (await page.createCDPSession()).send('Emulation.setEmulatedMedia', { features: [{ name: 'forced-colors', value: 'active' }] });
  for (const list of ['#forms button', '#presets button']) {
    const colours = await page.$$eval(list, (all) => all.map((it) => [it.ariaSelected === 'true' || it.ariaPressed === 'true', getComputedStyle(it).backgroundColor]));
    const chosen = colours.filter(([is]) => is).map(([, colour]) => colour);
    assert.equal(chosen.length, 1);
    assert.ok(colours.every(([is, colour]) => is === (colour === chosen[0])), String(colours));
  }
});

test('Tab goes in the order of the picture at every width', async () => {
  await open();
  for (const width of [1360, 1024, 700, 390]) {
    await page.resize(width, 2800);
    const sections = await page.evaluate(() => {
      const seen = [];
      for (const it of document.querySelectorAll('a, button, input, select, summary, [tabindex="0"]')) {
        const section = it.closest('.card, #begin, header');
        if (section && it.checkVisibility() && seen.at(-1) !== section) seen.push(section);
      }
      return seen.map((it) => ({ id: it.getAttribute('aria-labelledby') ?? it.id ?? it.tagName, x: Math.round(it.getBoundingClientRect().x), y: Math.round(it.getBoundingClientRect().y) }));
    });
    assert.ok(sections.length >= 6);
    assert.equal(new Set(sections.map(({ id }) => id)).size, sections.length, 'each is entered once');
    // Down the one column, and down the other.
    for (const isRight of [false, true]) {
      const column = sections.filter(({ x, y }) => isRight === (x > 500 && y > 100)).map(({ y }) => y);
      assert.deepEqual(column, column.toSorted((a, b) => a - b), String(width));
    }
  }
  const handles = await page.$$eval('g.handle', (all) => all.map((it) => Number(it.getAttribute('aria-valuenow'))));
  assert.deepEqual(handles, handles.toSorted((a, b) => a - b));
});

test('names of files are names of modules', async () => {
  await open();
  for (const [name, form, file] of [['liquid-crystal', 'rust', 'liquid_crystal.rs'], ['box', 'rust', 'box_.rs'], ['liquid-crystal', 'c', 'liquid_crystal.h'], ['box', 'csv', 'box.csv'], ['box', 'toml', 'box.toml']]) {
    await preset(name);
    await choose(form);
    assert.equal((await saved(() => page.click('#save'))).name, file);
  }
});

/** A static host under a path. */
async function host(folder) {
  const state = { missing: null };
  const types = { html: 'text/html', js: 'text/javascript', css: 'text/css', wasm: 'application/wasm', svg: 'image/svg+xml', csv: 'text/csv' };
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname).replace(/^\/a\/path\//, '').replace(/^$/, 'index.html');
    const file = join(folder, path);
    if (!existsSync(file) || state.missing?.test(path)) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': types[path.split('.').pop()] }).end(readFileSync(file));
  });
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  return Object.assign(state, { url: `http://127.0.0.1:${server.address().port}/a/path/`, end: () => (server.closeAllConnections(), server.close()) });
}

test('under any path the page is whole; where a script or the WebAssembly is missing, it says so', async () => {
  const server = await host(join(ROOT, 'designer', 'dist'));
  try {
    for (const missing of [null, /engine\.wasm$/, /page\.js$/]) {
      server.missing = missing;
      const page = extend(await (await browser.createBrowserContext()).newPage());
      await page.goto(server.url);
      if (missing?.test('engine.wasm')) await page.waitForSelector('#missing.now');
      else if (!missing) await ready(page);
      await page.evaluate(() => document.getAnimations().forEach((animation) => animation.finish()));
      assert.equal(await page.isSeen('#missing'), Boolean(missing), String(missing));
      if (missing) assert.match(await page.text('#missing'), /^The page is not whole/);
    }
  } finally {
    server.end();
  }
});

test('the picture is saved as an SVG', async () => {
  await open();
  const { name, path } = await saved(() => page.click('#svg'));
  assert.equal(name, 'soft.svg');
  const svg = readFileSync(path, 'utf8');
  // In a page whose policy allows styles.
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

test('a fit keeps no delay and no nominal speed of the last shutter, nor a gap that nobody gave', async () => {
  await open('');
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
  await page.until(() => document.querySelector('#trace [name=rises]').value === 'true' && document.getElementById('busy').hidden);
  assert.deepEqual([await page.value('#nominal'), await page.value('#min_gap')], ['8', '0.05']);
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
  assert.match(await page.text('#code'), /^There is nothing to copy yet/);
  for (const id of ['ticks', 'ticks-note']) assert.ok(!(await page.isSeen(`#${id}`)), id);
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
  await open('');
  await page.fill('#triggers', '12');
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
  assert.match(await page.text('#facts'), /at the trace’s own times/);
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
  await page.until(() => /Changed by hand.*misses the trace by/.test(document.getElementById('facts').textContent));
  await page.mouse.up();
  assert.doesNotMatch(await page.text('#facts dl'), /own times|curve explains the trace/);
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
    assert.match(await page.text('#code'), /^There is nothing to copy yet: no curve explains this trace/);
    for (const id of ['copy', 'save', 'link', 'svg']) assert.ok(await page.isDisabled(`#${id}`), id);
  };
  await isDoubted();
  assert.match(await page.text('#facts'), /the model's, and off by more than their errors say/);
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
  const told = Number(/misses the trace by ([\d.]+) %/.exec(await page.text('#facts'))[1]);
  assert.ok(told > 3, String(told));
  assert.doesNotMatch(await page.text('#facts'), /the curve explains the trace/);
  await page.press('Escape');
  await page.mouse.up();
  assert.equal(await page.attribute('path.residual', 'd'), before);
  await page.says('the curve explains the trace');
});

test('a scene in TOML is as it was written, to the bits of its timer, and what a person gave in it stays', async () => {
  await open();
  const text = 'unit = "ms"\nopen_start = 0\nopen_end = 2\nclose_start = 6\nclose_end = 15\ntriggers = 7\ntimer_hz = 2000000\ntimer_bits = 16\nmin_gap = 0.25\ndelay = 1\ndelay_spread = 0.02\n';
  const file = join(scratch, 'short.toml');
  writeFileSync(file, text);
  await drop(['short.toml', text]);
  await page.until(() => document.getElementById('name').value === 'short');
  for (const form of ['rust', 'json', 'c']) assert.equal(await copied(form), shutter('plan', file, '--emit', form), form);
  assert.match(await copied('rust'), /u16/);
  const link = await copiedBy(() => page.click('#link'));
  await open(link.slice(url.length));
  assert.equal(await copied('json'), shutter('plan', file, '--emit', 'json'));
  const [, told] = /^drift +(.*)$/m.exec(shutter('plan', file));
  assert.equal((await page.text('#drift')).toLowerCase(), `${told}.`);
  await page.fill('#unit', 'µs');
  assert.match(await copied('toml'), /^delay_spread = 20$/m);
  await page.fill('#unit', 'ms');
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
  await done(() => preset('trapezoid'));
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
  await page.until(() => designer.model.now.scene.name === 'soft');
  await page.mouse.move(x + 90, y, { steps: 4 });
  await page.mouse.up();
  assert.equal(await page.value('#name'), 'soft');
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

test('what is wrong is told in the words and the unit of the page', async () => {
  const told = async (hash, changes, words) => {
    await open(hash);
    for (const [id, value] of Object.entries(changes)) await page.fill(`#${id}`, value);
    assert.match(await page.text('#problem'), words);
    assert.doesNotMatch(await page.text('#problem'), /`|\bticks?\b|trigger s/);
  };
  await told('#name=triangle&unit=ms&times=0,50,50,100&triggers=20&timer_hz=1000000&min_gap=2&pulse=1', { pulse: '9' }, /^pulses of 9 ms: pulses 0 and 1 overlap by 0\.\d+ ms, and 2 ms is required; those of up to 0\.\d+ ms fit, or up to 5 flashes keep that/);
  await told(SOFT, { delay: '-1' }, /^sync delay: 0 or more is required; an edge cannot trigger what comes before it/);
  await told(SOFT, { timer_hz: '2.5' }, /^flashes 0 and 1 come 0 ms apart, and 400 ms is required; 1 flash keeps that/);
});

test('the photograph follows the drag and the number of flashes; nothing moves unasked', async () => {
  await open();
  const photos = () => page.$$eval('.photos canvas', (all) => all.map((it) => it.toDataURL()));
  const first = await photos();
  await drawn();
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
  for (const [x, n] of [[0, 1], [3, 4], [15, 16], [35, 64], [55, 256]]) {
    await slide(x);
    assert.equal(await page.value('#triggers'), String(n));
    assert.equal((await ticks()).length, n);
  }
  await page.click('#play');
  await page.until(() => designer.model.isPlaying && designer.model.cursor > designer.model.view.times[0]);
  await page.until(() => !designer.model.isPlaying);
});

test('several traces make a table of speeds, which prints, and a link that holds it', async () => {
  await open();
  await drop(['250.csv', trace({ open: 1.5 })], ['125.csv', trace({ open: 5.5 })], ['bounce.csv', bouncing()], ['diary.csv', 'dear diary\nnothing\n']);
  await page.waitForSelector('#speeds:not([hidden])');
  const table = () => page.$$eval('#speeds-table tbody tr', (all) => all.map((row) => [...row.children].map((it) => it.textContent)));
  let rows = await table();
  assert.deepEqual(rows.map((row) => row[0]), ['250.csv', 'bounce.csv', '125.csv', 'diary.csv']);
  assert.deepEqual([rows[0][2], rows[2][2]], ['1/250', '1/125']);
  assert.match(rows[0][1], /^(3\.99|4\.00)\d? ± [\d.e-]+ ms$/);
  const places = (number) => number.split('.')[1].length;
  for (const row of rows.slice(0, 3)) assert.equal(places(row[1].split(' ')[0]), places(row[1].split(' ')[2]), row[1]);
  // The table alone; whoever knows the dial says it.
  assert.ok(!(await page.isSeen('#graph')));
  assert.deepEqual(rows.map((row) => row[4]), ['–', '–', '–', '–']);
  await page.$$eval('#speeds-table input', ([it]) => {
    it.value = '1/250';
    it.dispatchEvent(new Event('change'));
  });
  assert.match((rows = await table())[0][4], /^[+−±]0\.0\d EV$/);
  assert.match(rows[1][7], /the trace itself/);
  assert.match(rows[3][7], /^not measured: .*no row of numbers in it/);
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
  await open(SOFT, { width: 1440, height: 900 });
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
  await drop(['clipped.csv', clipped()]);
  await fitted('clipped.csv');
  assert.ok(await page.isSeen('#facts .doubt'));
});

test('the table of ticks has the columns of the CSV, and fits at 1024', async () => {
  await open(SOFT, { width: 1024, height: 2800 });
  await page.fill('#min_gap', '0');
  await page.fill('#lamp', 'duty');
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

test('a finger reads the graph; at 320 pixels nothing overflows, nor with large letters', async () => {
  await open(SOFT, { width: 320, height: 2000, hasTouch: true });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  const { x, y, width, height } = await page.box('#graph');
  await page.touchscreen.tap(x + width / 2, y + height / 3);
  assert.match(await page.text('#readout'), /% open · .*% collected · flash \d+: tick \d+$/);
  // No word is cut.
  await page.fill('#delay', '123.5');
  const cut = await page.$$eval('#readout, #facts dd', (all) => all.filter((it) => it.scrollWidth > it.clientWidth || it.scrollHeight > it.clientHeight + 1).map((it) => it.textContent));
  assert.deepEqual(cut, []);
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
