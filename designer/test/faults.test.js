// What once went wrong, a test each: the page hangs nowhere, states nothing that nobody gave, and doubts what is doubtful.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { SOFT, clipped, complaints, copied, copiedBy, curve, drag, drop, fitted, forgive, hold, open, page, preset, refused, setUp, settled, trace, url } from './harness.js';

setUp();

const facts = () => page.text('#facts');

test('a fraction of a flash is refused, typed or linked, and nothing hangs', async () => {
  await open();
  await page.fill('#min_gap', '5');
  await page.fill('#triggers', '12.5');
  assert.match(await page.text('#problem'), /“12\.5” is no whole number/);
  await open(SOFT.replace('triggers=12', 'triggers=12.5'));
  assert.match(await page.text('#problem'), /(flashes|triggers): a whole number is required/);
  // As far as a number goes: no handle searches for ever.
  await open(SOFT.replace('7.5,10', '1e300,1e301'));
  await page.press('Control+z');
  await page.fill('#close_end', '1e300');
  await page.focus('#handle-close_start');
  for (const key of ['End', 'ArrowLeft', 'Home']) await page.press(key);
  assert.ok(await page.isSeen('#graph'));
});

test('a trace that is refused beside a good one: the handles, the address and the steps stay right', async () => {
  await open();
  await drop(['good.csv', trace()]);
  await fitted('good.csv');
  await drop(['bad.csv', refused()]);
  await page.until(() => document.querySelector('#trace .wrong'));
  await drag('open_end', 20, 0);
  await page.mouse.up();
  await settled();
  const moved = await page.value('#open_end');
  await page.press('Control+z');
  await settled();
  await page.press('Control+Shift+Z');
  await settled();
  assert.equal(await page.value('#open_end'), moved);
});

test('a part that cannot be drawn is told, and the address stays right', async () => {
  await open();
  await page.evaluate(() => (CanvasRenderingContext2D.prototype.putImageData = () => { throw new Error('no canvas'); }));
  await page.fill('#open_end', '2.25');
  await page.blur('#open_end');
  await settled();
  assert.match(await page.text('#missing'), /could not be drawn: no canvas/);
  await page.press('Control+z');
  await settled();
  assert.equal(await page.value('#open_end'), '2.5');
  assert.ok(complaints.length);
  forgive();
});

test('a clipped trace is doubted on the screen, in every form, link and row', async () => {
  await open();
  await drop(['clipped.csv', clipped()]);
  await fitted('clipped.csv');
  assert.match(await facts(), /Exposure7\.\d+ ± [\d.]+ ms, as if fully openclipped: \d+ % of the pulse's samples stop/);
  for (const form of ['rust', 'c', 'toml', 'csv', 'json']) assert.match(await copied(form), /clipped: \d+ %/, form);
  JSON.parse(await copied('json'));
  const link = await copiedBy(() => page.click('#link'));
  // A hand on a handle does not make the trace a better one.
  await drag('open_end', 20, 0);
  await page.mouse.up();
  assert.match(await facts(), /clipped: \d+ %/);
  await open(link.slice(url.length));
  assert.match(await facts(), /clipped: \d+ %/);
  await drop(['clipped.csv', clipped()], ['clean.csv', trace()]);
  await page.waitForSelector('#speeds:not([hidden])');
  const doubts = () => page.$$eval('#speeds-table tbody tr', (all) => all.map((row) => [row.querySelector('th').textContent, row.querySelectorAll('.doubt').length]));
  const rows = await doubts();
  assert.deepEqual(rows.map(([name, n]) => [name, n > 0]).sort(), [['clean.csv', false], ['clipped.csv', true]]);
  const table = await copiedBy(() => page.click('#speeds-link'));
  await open(table.slice(url.length));
  assert.deepEqual(await doubts(), rows);
});

test('no speed of a dial is stated that nobody gave', async () => {
  await open();
  await drop(['hundredth.csv', trace({ open: 7.5, samples: 2000 })]);
  await fitted('hundredth.csv');
  assert.doesNotMatch(await page.text('.draw') + (await facts()), /EV|for 1/);
  await page.fill('#nominal', '1/100');
  assert.match(await facts(), /for 1\/100: .*EV/);
});

test('of two files with one name each row opens its own', async () => {
  await open();
  await drop(['TEK0001.csv', trace({ open: 1.5 })], ['TEK0001.csv', trace({ open: 5.5 })]);
  await page.waitForSelector('#speeds:not([hidden])');
  for (const [row, exposure] of [[1, /^(7\.9|8\.0)/], [0, /^(3\.9|4\.0)/]]) {
    await page.$$eval('#speeds-table tbody button', (all, row) => all[row].click(), row);
    await page.until((source) => new RegExp(source).test(document.querySelector('#facts dd')?.textContent), exposure.source);
    // Back is the table.
    await page.click('#undo');
    await page.waitForSelector('#speeds:not([hidden])');
  }
});

test('while a plan is refused the facts say nothing false', async () => {
  await open();
  await page.fill('#delay', '3');
  await page.fill('#timer_bits', '8');
  assert.ok(await page.isSeen('#problem'));
  assert.match(await facts(), /Sync3 ms before it opens/);
  assert.doesNotMatch(await facts(), /no delay known|do not fit|–/);
});

test('what is advised is the number that was meant', async () => {
  await open();
  for (const [id, text, words] of [
    ['open_end', '12 000 us', 'write 12000 us'], ['open_end', '1 1/2 s', 'write 1.5 s'], ['open_end', '1,500 ms', 'may be 1.5 ms or 1500 ms'], ['open_end', '1/1 000', 'write 1/1000'],
    ['timer_hz', '1.000 Hz', 'may be 1 Hz or 1000 Hz'], ['timer_hz', '1 5', 'is no number'],
    ['min_gap', '1.000,5', 'write 1000.5'], ['timer_hz', '1\u202f500', 'write 1500'], ['open_end', '1,234.5', 'write 1234.5'], ['open_end', '2 kHz', 'has an unknown unit'],
  ]) {
    await page.fill(`#${id}`, text);
    assert.ok((await page.text('#problem')).includes(words), `${text}: ${await page.text('#problem')}`);
  }
  await page.fill('#timer_hz', '32.768 kHz');
  await page.fill('#open_end', '2.5');
  assert.match(await copied('toml'), /^timer_hz = 32768$/m);
  await page.fill('#close_end', '0');
  assert.match(await page.text('#problem'), /^times out of order/);
});

test('the slider of flashes moves by its keys, and tells the number', async () => {
  await open();
  await page.fill('#min_gap', '0');
  await page.focus('#flashes');
  let last = 12;
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp', 'ArrowLeft', 'ArrowDown', 'ArrowLeft', 'ArrowLeft']) {
    await page.press(key);
    const n = Number(await page.value('#triggers'));
    assert.ok(/Right|Up/.test(key) ? n > last : n < last, `${key} ${last} ${n}`);
    assert.equal(await page.attribute('#flashes', 'aria-valuetext'), `${n} flashes`);
    last = n;
  }
  await page.press('End');
  assert.equal(await page.value('#triggers'), '256');
});

test('the facts of a fit are the report’s', async () => {
  await open();
  await preset('measured');
  await fitted('leaf.csv');
  const report = await page.$eval('#report pre', (it) => it.textContent);
  const [, efficiency] = /^efficiency +(at most [\d.]+ %)/m.exec(report);
  const [, exposure] = /^exposure +(.* ± \S+ ms)/m.exec(report);
  assert.ok((await facts()).includes(`Efficiency${efficiency}`) && (await facts()).includes(`Exposure${exposure}`), await facts());
});

test('what is told goes when its cause goes, and a hand ends no fit', async () => {
  await open();
  await copied('rust');
  assert.match(await page.text('#told'), /^Copied/);
  await page.fill('#open_end', '2.25');
  assert.equal(await page.text('#told'), '');
  await drop(['diary.csv', 'dear diary\nnothing\n']);
  await page.until(() => designer.model.pending);
  await page.fill('#open_end', '2.5');
  assert.ok(!(await page.isSeen('#problem')));
  await page.fill('#timer_hz', '333333.4');
  assert.match(await facts(), /planned as 333333 Hz/);
  // The fit comes, but takes nothing away that was drawn meanwhile.
  await hold();
  await drop(['bench.csv', trace()]);
  await page.waitForSelector('#busy:not([hidden])');
  await drag('open_end', 20, 0);
  await page.mouse.up();
  assert.ok(await page.isSeen('#busy'));
  const shown = await curve();
  await page.evaluate(() => release());
  await page.says('the curve was changed meanwhile');
  assert.equal(await curve(), shown);
  await page.push('Show the fit');
  await fitted('bench.csv');
  // Nor does a field that is wrong keep a table from being linked.
  await drop(['a.csv', trace()], ['b.csv', trace({ open: 5.5 })]);
  await page.waitForSelector('#speeds:not([hidden])');
  await page.fill('#open_end', 'x');
  assert.match(await copiedBy(() => page.click('#speeds-link')), /speeds=/);
});
