// docs/designer.png: made by `designer/test.sh picture`, to a third of its size where pngquant is installed.

import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';
import { ROOT, drawn, fill, fitted, open, page, preset, setUp, written } from './harness.js';

setUp();

test('the picture is made', async () => {
  await open('', { width: 1440, height: 1000 });
  await preset('measured');
  await fitted('leaf.csv');
  await fill({ set_up: 'emulated', timer_hz: '25 MHz', triggers: '12', min_gap: '0.1' });
  await page.blur('#min_gap');
  await page.$eval('body', (it) => it.scrollIntoView());
  await page.mouse.move(2, 2);
  await written();
  await drawn();
  const path = join(ROOT, 'docs', 'designer.png');
  await page.screenshot({ path });
  spawnSync('pngquant', ['--force', '--output', path, '128', path]);
});
