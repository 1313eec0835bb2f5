// Keeps the page for when there is no network. While there is one, every file is asked for anew.

const FILES = []; // build.sh lists them

addEventListener('install', (event) => {
  event.waitUntil(caches.open('designer').then((cache) => cache.addAll(['./', ...FILES])));
  skipWaiting();
});
addEventListener('activate', (event) => event.waitUntil(clients.claim()));
addEventListener('fetch', (event) => event.respondWith(answer(event.request)));

async function answer(request) {
  const cache = await caches.open('designer');
  try {
    const response = await fetch(request);
    if (response.ok) await cache.put(request, response.clone());
    return response;
  } catch {
    return (await cache.match(request, { ignoreSearch: true })) ?? Response.error();
  }
}
