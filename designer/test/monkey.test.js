// Anything in any order: after each action the screen, the model and the address are of one state, and no doubt is left
// out.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clipped, copied, drop, open, page, refused, setUp, settled, told, trace, written } from './harness.js';

setUp();

/** In each of five rounds from two seeds. */
const ACTIONS = Number(process.env.ACTIONS ?? 60);

/** In the page: acts so many times, and tells what does not hold after an action. */
async function play({ seed, count }) {
  const random = (n) => (seed = (seed * 48271) % 2147483647) % n;
  const $ = (id) => document.getElementById(id);
  const pick = (list) => list[random(list.length)];
  const { model, hash, inUnit, inWords, isSameShape, originOf, syncOf, valueOf } = designer;
  let before = null, edited = '';
  const until = async (is) => {
    for (let k = 0; k < 500 && !is(); k++) await new Promise((done) => setTimeout(done, 20));
  };
  const input = (id, value, isLeft = random(2)) => {
    edited = id;
    $(id).closest('details')?.setAttribute('open', '');
    $(id).focus();
    $(id).value = value;
    $(id).dispatchEvent(new Event('input', { bubbles: true }));
    if (isLeft) $(id).blur();
  };
  const handles = () => [...document.querySelectorAll('g.handle:not([hidden])')];
  const drag = () => {
    const handle = pick(handles());
    // As a browser does, what follows goes to the handle that captures the pointer: the nearest, not always this one.
    let captor = handle;
    for (const it of handles()) it.setPointerCapture = () => { captor = it; };
    const { x, y, width, height } = handle.lastElementChild.getBoundingClientRect();
    const send = (type, dx, dy) => {
      const at = { clientX: x + width / 2 + dx, clientY: y + height / 2 + dy };
      captor.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, button: 0, ...at }));
    };
    const [dx, dy] = [random(900) - 450, random(600) - 300];
    send('pointerdown', 0, 0);
    for (const part of [0.3, 0.7, 1]) send('pointermove', part * dx, part * dy);
    send(pick(['pointerup', 'pointerup', 'lostpointercapture']), dx, dy);
  };
  const key = (target, key, more) =>
    target.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, ...more }));
  const numbers = designer.FIELDS.filter((id) => !['pulse', 'duty', 'min_pulse'].includes(id));
  const values = [
    '1', '2,5', '0.3', '7', '-1', '1,000', '', 'x', '12', '12.5', '1e6', '1e300', '1/125', '16', '12 000 us', '0', '40',
    '32.768 kHz',
  ];
  const keys = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End', 'PageUp'];
  const number = () => input(pick(numbers), pick(values));
  const actions = {
    drag, number, another: number, straight: () => $('straight').click(), name: () => input('name', `n${random(1000)}`),
    preset: () => pick([...$('presets').children].slice(0, 4)).click(),
    unit: () => input('unit', pick(['s', 'ms', 'µs', 'ns'])),
    lamp: () => $('lamp').disabled || input('lamp', pick(['', 'pulse', 'duty'])),
    arrows: () => key(pick(handles()), pick(keys), { shiftKey: !random(4) }),
    undo: () => key(window, 'z', { ctrlKey: true }), redo: () => key(window, 'y', { ctrlKey: true }),
    remedy: () => pick([...document.querySelectorAll('#problem button, #by-hand button')])?.click(),
  };
  const faults = [], done = {};
  for (let i = 0; i < count; i++) {
    const name = pick(Object.keys(actions));
    done[name] = (done[name] ?? 0) + 1;
    edited = '';
    actions[name]();
    // Fields are written once the focus is elsewhere.
    await new Promise((done) => setTimeout(done));
    const fault = (words) => faults.push(`${i} ${name}: ${words}`);
    const { now: { scene, trace }, view, last, wrong } = model;
    for (const id of numbers.filter((id) => !/^[ty]\d/.test(id) && id !== 'nominal')) {
      const value = valueOf(scene, id), isTyped = wrong?.id === id || document.activeElement === $(id);
      if (!isTyped && $(id).value !== String(value ?? '')) fault(`${id} shows ${$(id).value}, is ${value}`);
    }
    // The edge of the sync stands still in the scene's own time, unless the sync is edited or the scene another.
    const edge = syncOf(scene).delay === null ? null : originOf(inUnit(scene, 'ms'));
    const isOther = edited === 'delay' || ['preset', 'undo', 'redo'].includes(name);
    if (edge !== null && before !== null && !isOther && !(Math.abs(edge - before) <= 1e-6 * (1 + Math.abs(before)))) {
      fault(`the edge moved from ${before} to ${edge}`);
    }
    before = edge;
    // Every fifth time, once the program has told of it: the facts are those of what is on the screen.
    if (i % 5 === 4 && !wrong?.reason) await until(() => model.told?.scene === scene);
    // Be it the engine or the program that finds it.
    const { told } = model, isWrong = told?.scene === scene && (wrong || told.wrong);
    if (isWrong && $('problem').hidden) fault('what is wrong is not told');
    if (view && model.told?.scene === scene) {
      const fit = trace && isSameShape(trace.scene, scene) ? trace.fit : null, { wrong, facts, doubts } = model.told;
      if ($('facts').inert !== Boolean(wrong && !fit)) fault('facts of what cannot be planned');
      const lines = [...(fit?.facts ?? facts).filter(({ key }) => key === 'exposure_s'), ...doubts];
      for (const text of $('facts').inert ? [] : lines.map(({ text }) => inWords(text))) {
        if (!$('facts').textContent.includes(text)) fault(`the facts lack: ${text}`);
      }
      const [a, b, c, d] = last.times;
      if (!(a <= b && b <= c && c <= d)) fault(`out of order: ${last.times}`);
      for (const it of handles().filter((it) => it.matches('.control'))) {
        const [now, least, most] = ['now', 'min', 'max'].map((name) => Number(it.getAttribute(`aria-value${name}`)));
        const room = (end) => 1e-4 * Math.abs(end) + 1e-9;
        const isIn = now >= least - room(least) && now <= most + room(most);
        if (!isIn) fault(`${it.id} is at ${now}, not in ${least} to ${most}`);
      }
    }
    if (wrong && !$('copy').disabled) fault('a plan is offered that there is not');
    if (i % 10 === 9) {
      before = null;
      // Undone, what is half typed goes; then the address is that of the screen.
      while (model.isDraft && !$('undo').disabled) $('undo').click();
      const isSettled = () => location.hash === hash(model.now);
      await until(isSettled);
      if (!isSettled()) fault(`the address is ${location.hash}, the screen ${hash(model.now)}`);
    }
  }
  return { faults, done };
}

/** All that a person sees of the scene, to the bit. */
const seen = () => page.evaluate(() => ({
  numbers: [...document.querySelectorAll('#numbers :is(input, select)')].map((it) => [it.id, it.checked, it.value]),
  curve: document.querySelector('#graph path.curve').getAttribute('d'),
  handles: [...document.querySelectorAll('g.handle')].map((it) => it.getAttribute('transform')),
  pressed: [...document.querySelectorAll('[aria-pressed=true]')].map((it) => it.dataset.name),
  facts: document.querySelector('#facts:not([inert])')?.textContent, address: designer.hash(designer.model.now),
}));

/** All steps back or forth. */
const goAll = (way) => page.evaluate((way) => {
  let steps = 0;
  for (const button = document.getElementById(way); !button.disabled && steps < 2000; steps++) button.click();
  return steps;
}, way);

for (const seed of [7, 2026]) {
  test(`anything in any order, from ${seed}`, { timeout: 900_000 }, async () => {
    await open('');
    await told();
    const first = await seen();
    const [good, bad] = [[['good.csv', trace()]], [['bad.csv', refused()]]];
    const two = [['TEK.csv', trace({ open: 1.5 })], ['TEK.csv', trace({ open: 5.5 })]];
    // One that is refused beside a good one, too.
    for (const [round, drops] of [[], [good], [good, bad], [[['clipped.csv', clipped()]]], [two]].entries()) {
      for (const files of drops) {
        await drop(...files);
        await page.until((n, name) => {
          const { busy, note, pending, now: { trace, speeds } } = designer.model;
          return !busy && (n > 1 ? speeds : note || (pending ?? trace)?.name === name);
        }, files.length, files[0][0]);
        if (files.length > 1) await page.click('#speeds-close');
      }
      const { faults, done } = await page.evaluate(play, { seed: seed + round, count: ACTIONS });
      assert.deepEqual(faults, []);
      assert.ok(Object.keys(done).length > 10, JSON.stringify(done));
      const { view, wrong, now } = await page.evaluate(() => {
        const { view, wrong, now } = designer.model;
        return { view, wrong, now: designer.toProgram(now.scene).flashes };
      });
      // What hardware gets is what is on the screen.
      if (view?.plan.Ok && !wrong && now.set_up && now.timer_hz && now.min_gap !== null) {
        await written();
        if (await page.isDisabled('#copy')) continue;
        const { triggers } = JSON.parse(await copied('json'));
        assert.deepEqual(triggers.map((it) => it.ticks), view.plan.Ok.ticks);
      }
    }
    const last = (await goAll('redo'), await told(), await seen());
    const steps = await goAll('undo');
    assert.ok(steps > 50, String(steps));
    await told();
    assert.deepEqual(await seen(), first);
    assert.equal(await goAll('redo'), steps);
    await told();
    assert.deepEqual(await seen(), last);
    await settled();
  });
}
