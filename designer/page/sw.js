// Keeps the page for when there is no network, or one too slow: a whole version of it, or none.

const VERSION = '@version@';
const FILES = []; // pack.sh lists them
/** Longer nobody waits for the network where the page is kept. */
const PATIENCE = 4000;

addEventListener('install', (event) => {
  event.waitUntil(keep());
  skipWaiting();
});
addEventListener('activate', (event) => event.waitUntil(tidy()));
addEventListener('fetch', (event) => {
  if (event.request.method === 'GET') event.respondWith(answer(event.request));
});

// One file that fails, and nothing is kept. What the browser itself has kept may be of another version.
async function keep() {
  const cache = await caches.open(VERSION);
  const asked = ['./', ...FILES.map((file) => `${VERSION}/${file}`)].map((path) => new Request(path, { cache: 'reload' }));
  await cache.addAll(asked);
  const page = await (await cache.match('./')).text();
  if (page.includes(`${VERSION}/`)) return;
  await caches.delete(VERSION);
  throw new Error('the page was renewed meanwhile');
}

async function tidy() {
  await clients.claim();
  for (const name of await caches.keys()) if (name !== VERSION) await caches.delete(name);
}

async function answer(request) {
  const cache = await caches.open(VERSION);
  const isPage = request.mode === 'navigate';
  const kept = await cache.match(isPage ? './' : request, { ignoreSearch: true });
  // Files are called by their content: what is kept is what is asked for.
  if (!isPage) return kept ?? fetch(request);
  try {
    const response = await fetch(request.url, { cache: 'no-cache', ...(kept && { signal: AbortSignal.timeout(PATIENCE) }) });
    return response.ok || !kept ? response : kept;
  } catch {
    return kept ?? Response.error();
  }
}
