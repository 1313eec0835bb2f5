// The page in Firefox: what a stranger does first. All else is held in Chromium.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch } from 'puppeteer-core';

const ROOT = join(import.meta.dirname, '..', '..');
let server, url, browser;

before(async () => {
  server = spawn(process.env.SHUTTER, ['design', '--no-open', '--port', '0', '--page', join(ROOT, 'designer', 'dist')], { stdio: ['ignore', 'pipe', 'inherit'] });
  const [told] = await once(server.stdout, 'data');
  url = String(told).match(/http:\S+/)[0];
  browser = await launch({ browser: 'firefox', executablePath: process.env.FIREFOX, headless: true, timeout: 120_000 });
});

after(async () => {
  await browser?.close();
  server?.kill();
});

test('in Firefox a trace is fitted, a handle dragged, and both undone', { timeout: 180_000 }, async () => {
  const page = await browser.newPage();
  const complaints = [];
  page.on('console', (message) => ['error', 'warn'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(String(error)));
  await page.setViewport({ width: 1280, height: 1500 });
  await page.goto(url);
  await page.waitForSelector('body[data-ready]');
  const values = () => page.$$eval('[role=slider]', (all) => all.map((one) => one.getAttribute('aria-valuenow')));
  const until = (what) => page.waitForFunction((what) => document.body.innerText.includes(what), { timeout: 60_000 }, what);
  const first = await values();

  await (await page.$('input[type=file]')).uploadFile(join(ROOT, 'cli', 'traces', 'leaf.csv'));
  await until('the curve explains the trace');
  // As `shutter fit` has it: see the README.
  await until('6.2541 ± 0.0015 ms');
  const fitted = await values();
  assert.notDeepEqual(fitted, first);

  const handle = (await page.$$('[role=slider]'))[1];
  const { x, y, width, height } = await handle.boundingBox();
  const [across, down] = [x + width / 2, y + height / 2];
  await page.mouse.move(across, down);
  await page.mouse.down();
  await page.mouse.move(across + 30, down - 10, { steps: 5 });
  await page.mouse.up();
  const dragged = await values();
  assert.notEqual(dragged[1], fitted[1]);

  const undo = async () => {
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
  };
  await undo();
  assert.deepEqual(await values(), fitted);
  await undo();
  assert.deepEqual(await values(), first);
  assert.deepEqual(complaints, []);
});
