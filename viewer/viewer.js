// Owns the page's buttons and keys; x3dom does the rest.
(function () {
  "use strict";
  var scene = document.querySelector("x3d");
  // The model stands on x3dom's Y: seen from above is its negative Y, from the front its negative Z.
  var views = {
    fit: function (r) { r.fitAll(); },
    reset: function (r) { r.resetView(); },
    top: function (r) { r.showAll("negY"); },
    front: function (r) { r.showAll("negZ"); },
    right: function (r) { r.showAll("negX"); }
  };
  function show(name) {
    if (scene && scene.runtime && views[name]) views[name](scene.runtime);
  }
  document.getElementById("views").addEventListener("click", function (event) {
    var button = event.target.closest("button");
    if (button) show(button.dataset.view);
  });
  document.addEventListener("keydown", function (event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    var name = { f: "fit", r: "reset", t: "top" }[event.key.toLowerCase()];
    if (!name) return;
    event.stopPropagation(); // x3dom has keys of its own
    show(name);
  }, true);
})();
