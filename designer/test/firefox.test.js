// The page in Firefox: what a stranger does first, and the main ones of the model's. All else is held in Chromium.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { ROOT, curve, drag, open, page, preset, ready, setUp, settled, values } from './harness.js';

setUp('firefox');

test('in Firefox a trace is fitted, a handle dragged, and both undone; a reload keeps the scene', async () => {
  await open(undefined, { width: 1280, height: 1500 });
  const first = await values();
  await settled();
  await (await page.$('input[type=file]')).uploadFile(join(ROOT, 'cli', 'traces', 'leaf.csv'));
  await page.says('the curve explains the trace');
  // As `shutter fit` has it: see the README.
  await page.says('6.2541 ± 0.0015 ms');
  await settled();
  const fitted = await values();
  await drag('open_end', 30, -10);
  await page.says('Changed by hand since the fit');
  await page.mouse.up();
  assert.notEqual((await values())[3], fitted[3]);
  await page.press('Control+z');
  assert.deepEqual(await values(), fitted);
  await settled();
  await page.press('Control+z');
  assert.deepEqual(await values(), first);
  await preset('box');
  await settled();
  const box = await curve();
  await page.reload();
  await ready();
  assert.equal(await curve(), box);
  await page.goBack();
  await page.until((d) => document.querySelector('path.curve').getAttribute('d') !== d, box);
  assert.deepEqual(await values(), first);
});
