// The examples that the page cannot run, and the word of their error: they need a library that is not linked.
export const LACKS = { "diagrid-roof.vs": "libcholmod" };
// Files that are not compared: the page cannot hold them beside the rest.
export const TOO_LARGE = { "city.vs": { stl: "it has 720 MB" } };
