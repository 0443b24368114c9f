// Comes before the code that emcc makes: with fetch, it would take a file of this machine for an address.
if (typeof process === "object") globalThis.fetch = undefined;
