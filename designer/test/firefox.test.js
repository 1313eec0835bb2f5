// The page in Firefox: what a stranger does first, and the main ones of the model's. All else is held in Chromium.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import {
  ROOT, bouncing, choose, curve, drag, drop, open, page, preset, ready, rows, setUp, settled, ticks, trace, values,
} from './harness.js';

setUp('firefox');

const LONG = { timeout: 180_000 };

test('in Firefox a trace is fitted, a handle dragged, and both undone; a reload keeps the steps', LONG, async () => {
  await open(undefined, { width: 1280, height: 1500 });
  const first = await values();
  await settled();
  await (await page.$('input[type=file]')).uploadFile(join(ROOT, 'cli', 'traces', 'leaf.csv'));
  await page.says('the curve explains the trace');
  // As `shutter fit` has it: see the README.
  await page.says('6.2541 ± 0.0015 ms');
  await settled();
  const [fitted, drawn] = [await values(), await curve()];
  await drag('open_end', 30, -10);
  await page.says('Changed by hand since the fit');
  await page.mouse.up();
  assert.notEqual((await values())[3], fitted[3]);
  await page.press('Control+z');
  assert.deepEqual(await values(), fitted);
  await settled();
  await preset('box');
  await settled();
  await page.reload();
  await ready();
  await page.goBack();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') === d, drawn);
  await page.press('Control+z');
  assert.deepEqual(await values(), first);
});

test('in Firefox a misfit is exported by its own times, and several traces make a table', LONG, async () => {
  await open(undefined, { width: 1280, height: 2800 });
  await drop(['bounce.csv', bouncing()]);
  await page.says('at the trace’s own times');
  await choose('toml');
  assert.match(await page.text('#code'), /trigger_times = /);
  assert.equal((await ticks()).length, 12);
  await drop(['250.csv', trace({ open: 1.5 })], ['125.csv', trace({ open: 5.5 })]);
  await page.waitForSelector('#speeds:not([hidden])');
  assert.deepEqual((await rows('#speeds-table tbody')).map((row) => row[2]), ['1/250', '1/125']);
});
