// A scene as TOML.

import { CHOICES, COUNTS, OPTIONAL, TIMES } from './scene.js';

const number = (x) => (x === Infinity ? 'inf' : x === -Infinity ? '-inf' : Math.abs(x) >= 1e15 ? x.toExponential() : String(x));
const array = (numbers) => `[${numbers.map(number).join(', ')}]`;

/** The scene as the text that `shutter plan` reads: by its curve, or by the times that a trace tells. */
export function toml(scene) {
  const { measured } = scene;
  const lines = [`# ${scene.name.replace(/[^\x20-\x7e]/g, '_')}`, ...scene.doubts.map(({ text }) => `# Warning: ${text.replace(/\s+/g, ' ')}`), `unit = "${scene.unit}"`];
  if (measured) lines.push('open_start = 0', `trigger_times = ${array(measured)}`);
  else TIMES.forEach((key, i) => lines.push(`${key} = ${number(scene.times[i])}`));
  if (scene.inner && !measured) lines.push(`shutteropening = ${array(scene.inner)}`);
  for (const key of [...COUNTS, ...OPTIONAL]) if (scene[key] !== null && !(measured && key === 'triggers')) lines.push(`${key} = ${number(scene[key])}`);
  for (const key of Object.keys(CHOICES)) if (scene[key] !== null) lines.push(`${key} = ${JSON.stringify(scene[key])}`);
  return lines.join('\n') + '\n';
}
