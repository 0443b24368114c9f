// Opens the page of the live view for the server of `vs view`.
import { Live } from "./live.js";

// The access token follows the # of the address, a part that browsers send to no server. The page sends it in a header.
// The other words after the # are values of parameters.
const words = location.hash.slice(1).split("&").map((word) => { try { return decodeURIComponent(word); } catch { return word; } }), token = words[0];

new Live({
  ask: (path, options = {}) => fetch(path, { ...options, headers: { "X-VS-Token": token }, referrerPolicy: "no-referrer" }),
  values: words.slice(1).filter((word) => word.indexOf("=") > 0).map((word) => [word.slice(0, word.indexOf("=")), word.slice(word.indexOf("=") + 1)]),
  link: (values) => location.origin + "/#" + token + values.map(([name, value]) => "&" + encodeURIComponent(name) + "=" + encodeURIComponent(value)).join(""),
});
