// The page beside the program `shutter` on the same scenes: in Chromium.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { once } from 'node:events';
import { cpSync, existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { connect } from 'node:net';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { ROOT, SCENES, browser, choose, complaints, copied, copiedBy, curve, drag, drawn, drop, extend, forgive, hold, middle, open, page, planned, played, preset, ready, saved, scratch, setUp,
  settled, shutter, start, ticks, trace, url, written } from './harness.js';

// Everything within one ramp or the other: the most that a curve can ask of the crate.
const ALL_RAMP = '#name=ramps&unit=ms&times=0,5,5,10&inner=0.2,0,0.3,1,0.7,1,0.8,0&triggers=256&timer_hz=10000000&min_gap=0';

setUp();

test('the first screen takes at most 100 kB, compressed', async () => {
  await open('', { width: 1440, height: 900 });
  const first = await page.evaluate(() => {
    const [{ startTime }] = performance.getEntriesByName('ready');
    return ['/', ...new Set(performance.getEntriesByType('resource').filter((it) => it.startTime < startTime).map((it) => new URL(it.name).pathname))];
  });
  assert.ok(first.length >= 9, String(first));
  const size = (path) => gzipSync(readFileSync(join(ROOT, 'designer', 'dist', path === '/' ? 'index.html' : path)), { level: 9 }).length;
  const sum = first.reduce((sum, path) => sum + size(path), 0);
  console.log(`first screen: ${first.length} files, ${(sum / 1000).toFixed(1)} kB by gzip, of which engine.wasm ${(size(first.find((path) => path.endsWith('engine.wasm'))) / 1000).toFixed(1)}`);
  assert.ok(sum <= 100_000, String(sum));
});

test('every preset has the bits that the program has', async () => {
  await open();
  const names = readdirSync(SCENES).map((file) => file.replace('.toml', ''));
  assert.deepEqual((await page.$$eval('#presets b', (all) => all.map((it) => it.textContent))).sort(), names.sort());
  for (const name of names) {
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

test('a time takes its ramp along and keeps its shape', async () => {
  await open();
  await page.fill('#open_end', '5');
  assert.equal(await page.value('#t1'), '0.2');
  assert.equal(await page.value('#t2'), '0.3');
  assert.equal(await page.value('#t5'), '0.85');
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

test('two hundred actions are undone to the bit, and redone', async () => {
  await open();
  const [first, toml] = [await seen(), await copied('toml')];
  const counts = await page.evaluate(async () => {
    let seed = 7;
    const random = (n) => (seed = (seed * 48271) % 2147483647) % n;
    const $ = (id) => document.getElementById(id);
    const pick = (list) => list[random(list.length)];
    const input = (id, value) => {
      $(id).focus();
      $(id).value = value;
      $(id).dispatchEvent(new Event('input', { bubbles: true }));
      $(id).blur();
    };
    const drag = () => {
      const handle = pick([...document.querySelectorAll('g.handle')].filter((it) => it.style.display !== 'none'));
      handle.setPointerCapture = () => {};
      const { x, y, width, height } = handle.lastChild.getBoundingClientRect();
      const send = (type, dx, dy) => handle.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, button: 0, clientX: x + width / 2 + dx, clientY: y + height / 2 + dy }));
      const [dx, dy] = [random(160) - 80, random(120) - 60];
      send('pointerdown', 0, 0);
      send('pointermove', dx / 2, dy / 2);
      send('pointermove', dx, dy);
      send('pointerup', dx, dy);
    };
    const actions = {
      drag, preset: () => pick([...document.querySelectorAll('#presets button')]).click(),
      unit: () => input('unit', pick(['s', 'ms', 'µs', 'ns'])), lamp: () => input('lamp', pick(['', 'pulse', 'duty'])),
      straight: () => $('straight').click(), name: () => input('name', `n${random(1000)}`),
      key: () => pick([...document.querySelectorAll('g.handle')]).dispatchEvent(new KeyboardEvent('keydown', { key: pick(['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End', 'PageUp']), bubbles: true })),
      number: () => input(pick(['triggers', 'open_end', 'close_start', 't1', 'y2', 'nominal', 'min_gap', 'timer_hz']), pick(['1', '2,5', '0.3', '7', '-1', '1,000', '', 'x', '12', '1e6'])),
    };
    const done = {};
    for (let i = 0; i < 200; i++) {
      const name = pick(Object.keys(actions));
      actions[name]();
      done[name] = (done[name] ?? 0) + 1;
    }
    return done;
  });
  assert.ok(Object.keys(counts).length === 8, JSON.stringify(counts));
  const press = (key, shift) => page.evaluate(([key, shiftKey]) => {
    let steps = 0;
    const button = () => document.getElementById(shiftKey ? 'redo' : 'undo');
    for (; !button().disabled && steps < 1000; steps++) dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey, ctrlKey: true }));
    return steps;
  }, [key, shift]);
  await press('z', false);
  const undone = await press('Z', true);
  const last = await seen();
  assert.ok(undone > 100, `${undone} steps`);
  assert.notDeepEqual(last, first);
  assert.equal(await press('z', false), undone);
  assert.deepEqual(await seen(), first);
  assert.equal(await copied('toml'), toml);
  await press('Z', true);
  assert.deepEqual(await seen(), last);
});

test('Back and Forward, the buttons and the keys go the same steps', async () => {
  await open();
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
  const cut = await page.$$eval('#numbers input:not([type])', (all) => all.filter((it) => it.offsetWidth && it.scrollWidth > it.clientWidth).map((it) => `${it.id} ${it.value}`));
  assert.deepEqual(cut, []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 1024);
  for (const width of [1024, 320]) {
    await page.resize(width, 5000);
    assert.deepEqual(await page.$$eval('#ticks :is(th, td)', (all) => all.filter((it) => it.scrollWidth > it.clientWidth).map((it) => it.textContent)), [], String(width));
  }
});

test('a handle keeps within what is allowed: it slides along the border, and nothing else moves', async () => {
  await open('', { width: 1360, height: 1300 });
  await page.evaluate(() => {
    // So narrow that a digit more is a line more.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync('#facts dd { width: 110px }');
    document.adoptedStyleSheets = [sheet];
    const shifts = [];
    const keep = (list) => list.forEach(({ value, sources }) => shifts.push([value, ...sources.map(({ node, previousRect, currentRect }) => `${node?.outerHTML?.slice(0, 80) ?? node?.data} ${JSON.stringify([previousRect, currentRect])}`)]));
    const observer = new PerformanceObserver((list) => keep(list.getEntries()));
    observer.observe({ type: 'layout-shift', buffered: true });
    globalThis.take = () => (keep(observer.takeRecords()), shifts.splice(0));
  });
  const shifts = async () => {
    await written();
    await drawn();
    return page.evaluate(() => take());
  };
  for (const shown of ['leaf', 'led']) {
    await preset(shown);
    await shifts();
    for (const name of shown === 'leaf' ? ['open_start', 't1', 't2', 'open_end', 'close_start', 't5', 't6', 'close_end'] : ['t1', 'close_start', 'close_end']) {
      const [x, y] = await middle(name);
      await page.mouse.move(x, y);
      await page.mouse.down();
      for (const [dx, dy] of [[-60, -40], [-900, 5], [900, 600], [40, -900], [-300, 900]]) {
        await page.mouse.move(x + dx, y + dy);
        const state = await page.evaluate((name) => {
          // It is never outside the graph.
          const [box, at] = [document.getElementById('graph'), document.querySelector(`#handle-${name} > :last-child`)].map((it) => it.getBoundingClientRect());
          const isInside = at.left >= box.left && at.right <= box.right && at.top >= box.top && at.bottom <= box.bottom;
          return { isInside, copy: document.getElementById('copy').disabled, problem: document.getElementById('problem').hidden, alerts: document.querySelectorAll('[role=alert]:not([hidden]):not(#missing)').length };
        }, name);
        assert.deepEqual(state, { isInside: true, copy: false, problem: true, alerts: 0 }, `${shown}: ${name} by ${dx}, ${dy}`);
      }
      // The curve goes back, and with it the panels. Until a button is let go the browser keeps what it saw to itself.
      await page.keyboard.press('Escape');
      await page.mouse.up();
      assert.deepEqual(await shifts(), [], `${shown}: ${name}`);
    }
  }
  // Openness is 0 at least, not a rounding below.
  await preset('leaf');
  await drag('t1', 0, 300);
  await page.mouse.up();
  assert.equal(await page.value('#y1'), '0');
  // Along the border: held above 1 and moved to the side, it follows to the side.
  const t2 = Number(await page.value('#t2'));
  await drag('t2', -30, -300);
  await page.mouse.up();
  assert.ok(Number(await page.value('#t2')) < t2 - 0.02, 'it has slid');
  assert.ok(Number(await page.value('#y2')) > 0.95);
  assert.deepEqual(await planned('json', 'leaf'), await copied('json'));
});

test('handles in one place can each be taken', async () => {
  await open();
  await preset('projector');
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
  for (const name of ['soft', 'box', 'led', 'projector']) {
    await preset(name);
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
  await preset('led');
  await drag('close_start', -40, 0);
  await page.mouse.up();
  await page.fill('#name', 'my "curve" & <b>µ</b>');
  await page.until(() => location.hash.includes('my'));
  const [link, json, toml] = [await copiedBy(() => page.click('#link')), await copied('json'), await copied('toml')];
  await page.close();
  await open(link.slice(url.length));
  assert.equal(await copied('json'), json);
  assert.equal(await copied('toml'), toml);
  assert.equal(await page.value('#name'), 'my "curve" & <b>µ</b>');
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
  await tabTo('soft');
  await page.press('ArrowRight');
  await page.press('ArrowRight');
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
  await open('', { width: 390, height: 844, hasTouch: true });
  for (const name of ['soft', 'strobe', 'led']) {
    await preset(name);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, name);
  }
  await preset('soft');
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
  for (const id of ['ticks', 'set-ups', 'ticks-note']) assert.equal(writes[id] ?? 0, 0, `${id}: ${JSON.stringify(writes)}`);
  const most = Object.values(writes).reduce((sum, n) => sum + n, 0) / 10;
  console.log(`${most} writes a move`);
  assert.ok(most < 150, JSON.stringify(writes));
  // Once it is seen it is written.
  const asked = JSON.parse(await copied('json')).triggers.map((trigger) => trigger.ticks);
  await page.$eval('#ticks', (it) => it.scrollIntoView());
  await page.until((last) => document.querySelector('#ticks tbody tr:last-child').children[3].textContent === last, String(asked.at(-1)));
  assert.deepEqual(await ticks(), asked);
});

test('while a handle is dragged only the rows in sight are written, and all once it is let go', async () => {
  await open(ALL_RAMP, { width: 1360, height: 3200 });
  await page.until(() => document.querySelectorAll('#ticks tbody tr').length === 256);
  for (const isAtEnd of [false, true]) {
    await page.$eval('#ticks', (it, top) => it.parentElement.scrollTo(0, top), isAtEnd ? 1e5 : 0);
    await drawn();
    const before = await ticks();
    await drag('t2', -30, 10);
    const during = await ticks();
    const changed = during.flatMap((tick, i) => (tick === before[i] ? [] : [i]));
    assert.ok(changed.length > 8 && changed.length < 40 && changed.includes(isAtEnd ? 250 : 5), String(changed));
    await page.mouse.up();
    assert.deepEqual(await ticks(), JSON.parse(await copied('json')).triggers.map((trigger) => trigger.ticks));
  }
});

test('a newcomer sees pictures, words, the speed, and an exposure that plays unless motion is not wanted', async () => {
  await open('', { width: 1280, height: 900 });
  const pictures = await page.$$eval('#presets button', (all) => all.map((it) => [it.querySelector('path').getAttribute('d'), it.querySelector('small').textContent]));
  assert.equal(new Set(pictures.map(String)).size, 9);
  assert.ok(pictures.every(([d, words]) => d.length > 30 && words.length > 8));
  const text = await page.evaluate(() => {
    document.getElementById('inner').open = false;
    return document.querySelector('main').innerText;
  });
  const stories = await page.$$eval('#presets button', (all) => all.map((it) => it.dataset.story));
  assert.equal(new Set(stories).size, 9);
  assert.doesNotMatch(text + stories, /\bcdf\b|\b[ty][1-6]\b|open_start|\bT[EV]\b|emulated|Take away|\bBIC\b|direct/);
  assert.match(await page.text('header'), /shutter opens.*trace.*flash/s);
  for (const link of ['docs.rs/shutter-curve', 'docs.rs/crate/shutter-curve', 'measuring.md']) assert.ok(await page.count(`header a[href*="${link}"]`), link);
  // It plays, and what has come so far fills; then the picture is whole.
  const begun = await (await page.until(() => document.querySelector('path.cross').getAttribute('d') && document.getElementById('flashed').toDataURL())).jsonValue();
  await page.until(() => !document.querySelector('path.cross').getAttribute('d'));
  assert.notEqual(await page.evaluate(() => document.getElementById('flashed').toDataURL()), begun);
  await page.fill('#nominal', '8');
  assert.equal(await page.text('#speed'), '1/133 s for 1/125, −0.09 EV');
  await page.fill('#nominal', '');
  assert.equal(await page.text('#speed'), '1/133 s');
  await page.emulateMediaFeatures([{ name: 'prefers-reduced-motion', value: 'reduce' }]);
  await page.reload();
  await ready();
  await played();
  assert.equal(await page.attribute('path.cross', 'd'), '');
  await page.click('#play');
  await page.until(() => document.querySelector('path.cross').getAttribute('d'));
});

test('a dropped trace is fitted as the program fits it', async () => {
  await open();
  await drop(['bench.csv', trace()]);
  await page.waitForSelector('#trace dl');
  const [file, scene] = [join(scratch, 'bench.csv'), join(scratch, 'bench.toml')];
  writeFileSync(file, trace());
  const report = JSON.parse(shutter('fit', file, '--zero', 'open', '--triggers', '12', '--report', 'json', '--out', scene));
  // The fit's times and ramps, the page's triggers.
  const numbers = (text, keys) => Object.fromEntries(keys.map((key) => [key, (text.match(new RegExp(`^${key} = (.*?)( #.*)?$`, 'm')) ?? [])[1]]));
  const shape = ['unit', 'open_start', 'open_end', 'close_start', 'close_end', 'shutteropening'];
  assert.deepEqual(numbers(await copied('toml'), shape), numbers(readFileSync(scene, 'utf8'), shape));
  assert.match(await page.text('#trace'), /straight ramps/);
  assert.match(await page.text('#trace'), /explains the trace/);
  assert.match(await page.text('#trace'), /residual/);
  // The triggers and their errors are the program's.
  const told = (await page.text('#trace details pre')).trim().split('\n').slice(1).map((line) => line.split(/ +/).filter((x) => x !== '±').map(Number));
  report.triggers.forEach(({ time_s, error_s }, i) => {
    assert.ok(Math.abs(told[i][1] - 1e3 * (time_s - report.opens_s)) < 1e-5, `trigger ${i}`);
    assert.ok(Math.abs(told[i][2] / (1e3 * error_s) - 1) < 0.06, `error ${i}`);
  });
  assert.equal((await page.attribute('#graph path.errors', 'd')).split('H').length - 1, 12);
  assert.ok((await page.attribute('#graph path.trace', 'd')).length > 1000);
  assert.ok(Math.abs(Number(await page.value('#open_end')) - 2) < 0.05);
  // The example that is there to be tried.
  await page.click('#example');
  await page.until(() => /leaf\.csv/.test(document.getElementById('trace').textContent) && document.querySelector('#trace dl'));
  shutter('fit', join(ROOT, 'cli', 'traces', 'leaf.csv'), '--zero', 'open', '--triggers', '12', '--out', scene);
  assert.deepEqual(numbers(await copied('toml'), shape), numbers(readFileSync(scene, 'utf8'), shape));
  // A name is not a preset.
  assert.equal(await page.count('#presets [aria-pressed=true]'), 0);
  await page.push('Remove the trace');
  assert.equal(await page.attribute('#graph path.trace', 'd'), '');
});

test('a fit leaves what is not of the shutter, and is a step; what is wrong with a trace can be mended where it is told', async () => {
  await open();
  const value = (id) => page.value(`#${id}`);
  const trace = () => page.attribute('#graph path.trace', 'd');
  const choice = (name, value) => page.fill(`#trace [name=${name}]`, value);
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
  const before = await seen();
  // Times without a unit: seconds, until somebody says otherwise.
  await drop(['bench.csv', rows(0.01, (f) => 0.1 + 2 * f, 't,v\n')]);
  await page.waitForSelector('#trace .warnings li');
  assert.match(await page.text('#trace .warnings'), /does not say in which unit/);
  assert.deepEqual(await page.$$eval('#trace .preview tr', (all) => all.slice(0, 3).map((row) => [...row.children].map((it) => it.textContent))),
    [['line', 't time', 'v light'], ['2', '0.00000', '0.1000'], ['3', '0.0100000', '0.1168']]);
  assert.ok(Math.abs(Number(await value('open_end')) - 800) < 5, await value('open_end'));
  await page.push('Choose the unit');
  assert.equal(await page.evaluate(() => document.activeElement.name), 'unit');
  await select('unit', 'ms');
  await page.until(() => Math.abs(document.getElementById('open_end').value - 0.8) < 0.01);
  assert.ok(!/does not say/.test(await page.text('#trace')));
  assert.deepEqual([await value('pulse'), await value('min_gap'), await value('triggers'), await value('lamp'), await value('name')], ['0.011', '0.02', '12', 'pulse', 'bench']);
  assert.match(await page.text('#speed'), /^1\/\d+ s$/);
  // Each is a step; with the first the trace goes as well.
  await page.click('#undo');
  assert.ok(Number(await value('open_end')) > 700);
  await page.click('#undo');
  assert.deepEqual(await seen(), before);
  assert.equal(await trace(), '');
  assert.match(await page.text('#trace'), /^Drop the CSV/);
  await page.click('#redo');
  await page.waitForSelector('#trace dl');
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
  await page.waitForSelector('#trace dl');
  assert.ok(Math.abs(Number(await value('open_end')) - (80 / 100.5)) < 0.01, await value('open_end'));
  // Light that lowers the signal; asked to raise it, there is no dark to begin with, and that is mended as well.
  await drop(['down.csv', rows(1e-5, (f) => 3 - 2 * f, 'time (s),dark,light\n').replace(/,(?=[\d.]+$)/gm, ',0.5,')]);
  await page.until(() => /down\.csv/.test(document.querySelector('#trace h3')?.textContent) && document.querySelector('#trace dl'));
  assert.match(await page.text('#trace [name=rises] option'), /falls/);
  await select('rises', 'true');
  await page.waitForSelector('#trace .wrong');
  await page.push('Say which way');
  await select('rises', 'false');
  await page.waitForSelector('#trace dl');
  // A column without a pulse, chosen before the other choice is read.
  await hold();
  await choice('rises', '');
  await choice('signal', '2');
  await page.evaluate(() => release());
  await page.waitForSelector('#trace .wrong');
  assert.doesNotMatch(await page.text('main'), /--[a-z]|shutter fit/);
  await page.push('Choose the columns');
  await select('signal', '3');
  await page.waitForSelector('#trace dl');
  // A preset is another shutter.
  await preset('leaf');
  assert.equal(await trace(), '');
  await page.until(() => !document.querySelector('#trace dl'));
  await drop(['notes.csv', 'dear diary,\nnothing happened\n']);
  await page.waitForSelector('#trace .wrong');
  await preset('soft');
  await page.waitForSelector('#trace .wrong', { hidden: true });
});

test('a dropped scene is opened, and a broken one refused with its line', async () => {
  await open();
  await drop(['mine.toml', readFileSync(join(SCENES, 'projector.toml'), 'utf8')]);
  await page.until(() => document.getElementById('name').value === 'mine');
  assert.equal((await ticks()).length, 20);
  await drop(['mine.toml', 'open_start = 0\nopen_end = "soon"\n']);
  await page.waitForSelector('#problem.wrong');
  assert.match(await page.text('#problem'), /^mine\.toml:2: open_end: a number is required/);
  assert.equal(await page.value('#name'), 'mine');
  assert.equal((await ticks()).length, 20);
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
    await preset('soft');
    assert.ok(!(await page.isSeen('#problem')));
    assert.equal((await ticks()).length, 12);
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

test('without a network it goes on, and opens again', async () => {
  const server = await host(join(ROOT, 'designer', 'dist'));
  await visit(async (page) => {
    await page.goto(server.url);
    await ready(page);
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.until(() => navigator.serviceWorker.controller);
    server.end();
    await page.reload();
    await ready(page);
    await page.fill('#triggers', '7');
    await page.click('#form-c');
    await page.says('static const');
    assert.equal(await page.count('#ticks tbody tr'), 7);
  }, { width: 1360, height: 2800 });
});

test('a link is of the curve on the screen when it is clicked, and none of a wrong one', async () => {
  await open();
  const link = (change) => copiedBy(() => page.evaluate((change) => {
    // At once after another change, which the address is still to follow.
    document.querySelector('#presets [data-name="leaf"]').click();
    document.querySelector(change).click();
    document.getElementById('link').click();
  }, change));
  assert.match(await link('#presets [data-name="box"]'), /#name=box&/);
  assert.match(await link('#presets [data-name="strobe"]'), /#name=strobe&/);
  await page.fill('#close_start', '-9');
  for (const id of ['link', 'frame', 'svg', 'png', 'copy', 'save']) assert.ok(await page.isDisabled(`#${id}`), id);
});

test('a link that holds no curve does not show the shutter before', async () => {
  await open();
  assert.ok(await page.isSeen('#graph svg'));
  await page.evaluate(() => (location.hash = '#times=1'));
  await page.waitForSelector('body.void');
  assert.equal(await page.$$eval('main > *', (all) => all.filter((it) => it.checkVisibility()).map((it) => it.id).join()), 'presets');
  assert.equal(await page.count('[aria-pressed=true]'), 0);
  assert.match(await page.text('#problem'), /^The link holds no curve: times: 4 numbers are required/);
  assert.ok(await page.isDisabled('#link'));
  await page.push('Go on without it');
  assert.ok(await page.isSeen('#graph svg'));
  assert.equal(await page.value('#name'), 'soft');
});

test('two curves are compared, and the link has both', async () => {
  await open();
  await page.click('#compare');
  await preset('liquid-crystal');
  await page.until(() => document.querySelector('#graph path.other').getAttribute('d'));
  const other = await page.attribute('#graph path.other', 'd');
  assert.match(other, /^M.*C/);
  assert.ok(await page.isSeen('.other-key'));
  const link = await copiedBy(() => page.click('#link'));
  await page.close();
  await open(link.slice(url.length));
  assert.equal(await page.attribute('#graph path.other', 'd'), other);
  await page.click('#compare');
  await page.until(() => document.querySelector('#graph path.other').getAttribute('d') === '');
});

test('a frame shows the curve in another page', async () => {
  await open();
  await preset('leaf');
  const html = await copiedBy(() => page.click('#frame'));
  await page.goto(`${url}sw.js`);
  await page.setContent(`<!doctype html><title>Elsewhere</title>${html}`);
  // That file has no icon.
  forgive();
  const frame = extend(await (await page.waitForSelector('iframe')).contentFrame());
  await ready(frame);
  assert.ok(await frame.isSeen('#graph path.curve'));
  assert.equal(await frame.value('#name'), 'leaf');
  for (const id of ['presets', 'numbers', 'code', 'trace']) assert.ok(!(await frame.isSeen(`#${id}`)), id);
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
    doses: () => preset('led'),
    wrong: () => page.fill('#close_start', '-4'),
    trace: async () => {
      await page.click('#undo');
      await page.click('#example');
      await page.waitForSelector('#trace dl');
      await page.$$eval('#trace details', (all) => all.forEach((it) => (it.open = true)));
    },
    refused: async () => {
      await drop(['one.csv', Array.from({ length: 900 }, (_, i) => (i > 300 && i < 600 ? 1 : 0)).join('\n')]);
      await page.waitForSelector('#trace .wrong');
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
  assert.ok(nodeIds.length > 25);
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
  await open();
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
        const section = it.closest('.card, #presets, header');
        if (section && it.checkVisibility() && seen.at(-1) !== section) seen.push(section);
      }
      return seen.map((it) => ({ id: it.getAttribute('aria-labelledby') ?? it.id ?? it.tagName, x: Math.round(it.getBoundingClientRect().x), y: Math.round(it.getBoundingClientRect().y) }));
    });
    assert.ok(sections.length >= 7);
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

test('a picture is saved as a PNG', async () => {
  await open();
  const { name, path } = await saved(() => page.click('#png'));
  assert.equal(name, 'soft.png');
  const png = readFileSync(path);
  assert.equal(png.subarray(1, 4).toString(), 'PNG');
  const colours = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = data;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
    const found = new Set();
    for (let i = 0; i < bytes.length; i += 4) found.add(`${bytes[i]} ${bytes[i + 1]} ${bytes[i + 2]}`);
    return [image.width > 1000, ...['255 255 255', '0 114 178', '213 94 0', '164 211 240'].map((colour) => found.has(colour))];
  }, `data:image/png;base64,${png.toString('base64')}`);
  assert.deepEqual(colours, [true, true, true, true, true], 'its paper, curve, triggers and shares');
});

/** A static host under a path, whose browsers may keep all it sends for ten minutes. */
async function host(folder) {
  const state = { hangs: false, missing: null };
  const types = { html: 'text/html', js: 'text/javascript', css: 'text/css', wasm: 'application/wasm', svg: 'image/svg+xml', csv: 'text/csv', png: 'image/png' };
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname).replace(/^\/a\/path\//, '').replace(/^$/, 'index.html');
    const file = join(folder, path);

    if (state.hangs) return;
    if (!existsSync(file) || state.missing?.test(path)) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': types[path.split('.').pop()], 'Cache-Control': 'max-age=600' }).end(readFileSync(file));
  });
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  return Object.assign(state, { url: `http://127.0.0.1:${server.address().port}/a/path/`, end: () => (server.closeAllConnections(), server.close()) });
}

/** A browser of its own, without what others have kept. */
async function visit(run, size) {
  const other = await start();
  try {
    const page = extend(await other.newPage());
    if (size) await page.setViewport(size);
    await run(page);
  } finally {
    await other.close();
  }
}

test('on a host with max-age=600 a new version is whole, under any path; without the host the last one is', async () => {
  const [site, files] = [join(scratch, 'site'), join(scratch, 'files')];
  cpSync(join(ROOT, 'designer', 'dist'), site, { recursive: true });
  const [version] = readdirSync(site).filter((name) => !name.includes('.'));
  assert.match(version, /^[0-9a-f]{12}$/, 'its name is its content');
  const pack = () => execFileSync(join(ROOT, 'designer', 'pack.sh'), [files, site]);
  cpSync(join(site, version), files, { recursive: true });
  for (const name of ['index.html', 'sw.js']) {
    writeFileSync(join(files, name), readFileSync(join(site, name), 'utf8').replaceAll(version, '@version@').replace(/FILES = \[.*\]/, 'FILES = []'));
  }
  pack();
  assert.deepEqual(readdirSync(site).sort(), [version, 'index.html', 'sw.js'], 'the same content has the same name');
  // The next version: the page's text and its script belong together.
  const renew = () => {
    const edit = (name, from, to) => {
      const text = readFileSync(join(files, name), 'utf8');
      assert.ok(text.includes(from), name);
      writeFileSync(join(files, name), text.replace(from, to));
    };
    edit('index.html', '<h1>Curve designer', '<h1>New designer');
    edit('main.js', "document.body.dataset.ready = ''", "document.body.dataset.ready = 'new'");
    pack();
  };
  const server = await host(site);
  try {
    const whole = async (page) => {
      await page.waitForSelector('body[data-ready]');
      return page.evaluate(() => [document.querySelector('h1').textContent, document.body.dataset.ready, document.querySelector('#graph path.curve').getAttribute('d').length > 50]);
    };
    const [old, renewed] = [['Curve designer', '', true], ['New designer', 'new', true]];
    const isEither = (found) => [old, renewed].some((it) => JSON.stringify(it) === JSON.stringify(found));
    // What is kept whole is a version, and nothing else is kept.
    const isKept = (page, isOld) => page.until(async (version, isOld, count) => {
      const names = await caches.keys();
      return names.length === 1 && (names[0] === version) === isOld && (await (await caches.open(names[0])).keys()).length === count;
    }, version, isOld, readdirSync(files).length - 1);
    await visit(async (page) => {
      await page.goto(server.url);
      assert.deepEqual(await whole(page), old);
      await page.evaluate(() => navigator.serviceWorker.ready);
      await isKept(page, true);
      await visit(async (bare) => {
        // One without the worker, which has kept the old version's files as the host lets it.
        await bare.evaluateOnNewDocument(() => delete Navigator.prototype.serviceWorker);
        await bare.goto(server.url);
        await whole(bare);
        renew();
        await bare.goto('about:blank');
        await bare.goto(server.url);
        const found = await whole(bare);
        assert.ok(isEither(found), String(found));
      });
      // A machine that is busy may find the network slow, and show what is kept once more.
      let found;
      for (let i = 0; i < 5 && found?.[1] !== 'new'; i++) {
        await page.goto('about:blank');
        await page.goto(server.url);
        found = await whole(page);
        assert.ok(isEither(found), String(found));
      }
      assert.deepEqual(found, renewed);
      await isKept(page, false);
      // A host that takes the connection and says nothing.
      server.hangs = true;
      await page.goto('about:blank');
      await page.goto(server.url);
      assert.deepEqual(await whole(page), renewed);
    });
  } finally {
    server.end();
  }
});

test('where a script or the WebAssembly is missing, the page says so', async () => {
  const server = await host(join(ROOT, 'designer', 'dist'));
  try {
    await visit(async (first) => {
      for (const missing of [/engine\.wasm$/, /main\.js$/, /scene\.js$/, /export\.js$/]) {
        server.missing = missing;
        const page = extend(await (await first.browser().createBrowserContext()).newPage());
        await page.goto(server.url);
        if (missing.test('engine.wasm') || missing.test('export.js')) await page.waitForSelector('#missing.now');
        else await page.evaluate(() => document.getAnimations().forEach((animation) => animation.finish()));
        assert.ok(await page.isSeen('#missing'), String(missing));
        assert.match(await page.text('#missing'), /^The page is not whole/);
      }
    });
  } finally {
    server.end();
  }
  await open();
  await page.evaluate(() => document.getAnimations().forEach((animation) => animation.finish()));
  assert.ok(!(await page.isSeen('#missing')));
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
