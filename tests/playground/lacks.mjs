// The examples that the page cannot run, and the word of their error: they need a library that is not linked.
export const LACKS = { "diagrid-roof.vs": "libcholmod", "diagrid-tower.vs": "libcholmod", "gare-analysed.vs": "libcholmod" };
// Files that are not compared: the page cannot hold them beside the rest.
export const TOO_LARGE = { "city.vs": { stl: "it has 720 MB" } };
// Files that have a few other triangles, with the reason: a last bit decides on which side of a plane a corner lies.
export const OTHER_TRIANGLES = { "gyroid-pavilion.vs": { stl: "sin and cos in the gyroid's function", glb: "sin and cos in the gyroid's function" } };
