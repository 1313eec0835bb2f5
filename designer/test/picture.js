// docs/designer.png: run by designer/picture.sh.

import { join } from 'node:path';
import { test } from 'node:test';
import { ROOT, drawn, fitted, open, page, preset, setUp, written } from './harness.js';

setUp();

test('the picture is made', async () => {
  await open('', { width: 1440, height: 1000 });
  await preset('measured');
  await fitted('leaf.csv');
  for (const [id, value] of Object.entries({ set_up: 'emulated', timer_hz: '25 MHz', triggers: '12' })) {
    await page.fill(`#${id}`, value);
  }
  await page.blur('#triggers');
  await page.$eval('body', (it) => it.scrollIntoView());
  await page.mouse.move(2, 2);
  await written();
  await drawn();
  await page.screenshot({ path: join(ROOT, 'docs', 'designer.png') });
});
