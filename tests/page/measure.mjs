// Owns the test of the readings between two marks, for each pair of kinds, against their formulas, turned by odd angles.
import * as THREE from "three";
import { alone, between } from "../../backends/page/measure.js";

const turn = new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(0.37, -1.1, 2.3)).setPosition(33, -47, 21);
// The page has positions of 32 bits, some way from the middle of the model.
const round = (p) => p.set(...p.toArray().map(Math.fround));
const v = (...xyz) => round(new THREE.Vector3(...xyz).applyMatrix4(turn)), way = (...xyz) => new THREE.Vector3(...xyz).transformDirection(turn);
const point = (...xyz) => ({ kind: "point", at: v(...xyz) });
const edge = (a, b) => { const ends = [v(...a), v(...b)]; return { kind: "edge", ends, at: ends[0].clone().add(ends[1]).multiplyScalar(0.5), length: ends[0].distanceTo(ends[1]) }; };
const face = (at, normal) => ({ kind: "face", at: v(...at), normal: way(...normal), area: 1 });

function check(name, a, b, distance, angle = null) {
  const faults = [];
  for (const [p, q] of [[a, b], [b, a]]) {
    const { words, from, to } = between(p, q, "m"), found = words.match(/^(?:\D+ {3})?([\d.]+)°/)?.[1] ?? null, size = words.match(/(?:^|\s)([\d.]+) m/)?.[1] ?? null;
    if (found !== angle) faults.push(`angle ${found}, not ${angle}`);
    if (distance === null ? size !== null : size === null || Math.abs(Number(size) - distance) > 0.005) faults.push(`distance ${size}, not ${distance}`);
    if (distance !== null && Math.abs(from.distanceTo(to) - distance) > 1e-4) faults.push(`the line has the length ${from.distanceTo(to)}`);
  }
  console.log(`${faults.length ? "not ok" : "ok"} page/measure:${name}`);
  for (const fault of faults) console.log("    " + fault);
}

check("two corners", point(0, 0, 0), point(1, 2, 2), 3);
check("a corner and an edge", point(0.5, 3, 4), edge([0, 0, 0], [1, 0, 0]), 5);
check("a corner beyond an edge's end", point(4, 4, 0), edge([0, 0, 0], [1, 0, 0]), 5);
check("a corner and a face", point(5, 6, 7), face([0, 0, 2], [0, 0, 1]), 5);
check("parallel edges", edge([0, 0, 0], [2, 0, 0]), edge([1, 3, 4], [5, 3, 4]), 5);
check("short parallel edges", edge([0, 0, 0], [0.05, 0, 0]), edge([0, 0, 3], [0.05, 0, 3]), 3);
check("skew edges", edge([-1, 0, 0], [1, 0, 0]), edge([0, -1, 2], [0, 1, 2]), 2, "90.0");
check("edges that meet", edge([0, 0, 0], [1, 0, 0]), edge([0, 0, 0], [1, 1, 0]), null, "45.0");
check("an edge and a face it is parallel to", edge([0, 0, 3], [1, 0, 3]), face([9, 9, 1], [0, 0, 1]), 2);
check("an edge and a face it leans on", edge([0, 0, 3], [1, 0, 4]), face([9, 9, 1], [0, 0, 1]), null, "45.0");
check("parallel faces", face([1, 2, 0], [0, 0, 1]), face([7, 8, 4], [0, 0, -1]), 4);
check("two points of one face", face([0, 0, 0], [0, 0, 1]), face([3, 4, 0], [0, 0, 1]), 5);
check("faces that lean", face([0, 0, 0], [0, 0, 1]), face([1, 0, 0], [0, 1, 1]), null, "45.0");
const wall = (at, axis, radius, mark) => ({ kind: "face", at: v(...mark), normal: way(1, 0, 0), area: 1, surface: { form: "cylinder", at: v(...at), axis: way(...axis), radius, area: 62.83 } });
const ball = (at, radius) => ({ kind: "face", at: v(at[0] + radius, at[1], at[2]), normal: way(1, 0, 0), area: 1, surface: { form: "sphere", at: v(...at), axis: way(0, 0, 1), radius, area: 12.57 } });
check("parallel cylinders", wall([0, 0, 0], [0, 0, 1], 2, [2, 0, 1]), wall([3, 4, 9], [0, 0, 1], 1, [4, 4, 3]), 5);
check("a cylinder and a face that it is parallel to", wall([0, 0, 0], [0, 0, 1], 2, [2, 0, 1]), face([7, 1, 1], [1, 0, 0]), 7);
check("a cylinder and a corner", wall([0, 0, 0], [0, 0, 1], 2, [2, 0, 1]), point(3, 4, 77), 5);
check("cylinders that cross", wall([0, 0, 0], [0, 0, 1], 2, [2, 0, 1]), wall([0, 3, 1], [1, 0, 0], 1, [0, 4, 1]), 3, "90.0");
check("two spheres", ball([0, 0, 0], 1), ball([0, 3, 4], 2), 5);
const says = (name, mark, wanted) => { const told = alone(mark, "m", [1, 1, 1]); console.log(`${told === wanted ? "ok" : "not ok"} page/measure:${name}`); if (told !== wanted) console.log("    " + told); };
says("a cylinder's radius and area", wall([0, 0, 0], [0, 0, 1], 2, [2, 0, 1]), "radius 2 m   62.83 m²");
says("a sphere's radius and area", ball([0, 0, 0], 1), "radius 1 m   12.57 m²");
const corner = alone(point(0, 0, 0), "m", [1, 1, 1]);
console.log((corner === "34, -46, 22" ? "ok" : "not ok") + " page/measure:a corner's place is the model's");
