// Keeps the playground's files, so that it opens without a network after the first visit. A new version of a file takes
// the place of the kept one whenever the network gives it.
const KEPT = "visualscheme";

self.addEventListener("install", (event) => event.waitUntil(self.skipWaiting()));
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
self.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET" || new URL(event.request.url).origin !== self.location.origin) return;
  event.respondWith((async () => {
    const kept = await caches.open(KEPT);
    try {
      const answer = await fetch(event.request);
      if (answer.status === 200) await kept.put(event.request, answer.clone());
      return answer;
    } catch (error) {
      const answer = await kept.match(event.request, { ignoreSearch: true });
      if (answer) return answer;
      throw error;
    }
  })());
});
