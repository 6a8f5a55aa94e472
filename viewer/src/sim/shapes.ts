/** Shapes that can be inserted into a world. */

export interface Shape {
  name: string;
  sdf: string;
}

function model(
  name: string,
  z: number,
  geometry: string,
  color: string,
  massKg: number,
  inertia: number[],
): Shape {
  const [ixx, iyy, izz] = inertia;
  const shape = `<geometry>${geometry}</geometry>`;
  const material = `<material><ambient>${color}</ambient><diffuse>${color}</diffuse></material>`;
  return {
    name,
    sdf:
      `<sdf version="1.6"><model name="${name}"><link name="link"><pose>0 0 ${z} 0 0 0</pose>` +
      `<inertial><mass>${massKg}</mass><inertia><ixx>${ixx}</ixx><ixy>0</ixy><ixz>0</ixz>` +
      `<iyy>${iyy}</iyy><iyz>0</iyz><izz>${izz}</izz></inertia></inertial>` +
      `<collision name="collision">${shape}</collision>` +
      `<visual name="visual">${shape}${material}</visual></link></model></sdf>`,
  };
}

export function box(
  x: number,
  y: number,
  z: number,
  massKg: number,
  name = 'box',
  color = '0.85 0.55 0.2 1',
): Shape {
  const inertia = [y * y + z * z, x * x + z * z, x * x + y * y].map(
    (v) => +((massKg * v) / 12).toPrecision(6),
  );
  return model(name, z / 2, `<box><size>${x} ${y} ${z}</size></box>`, color, massKg, inertia);
}

export function cylinder(
  radius: number,
  length: number,
  massKg: number,
  name = 'cylinder',
  color = '0.25 0.6 0.85 1',
): Shape {
  const side = (massKg * (3 * radius * radius + length * length)) / 12;
  const inertia = [side, side, (massKg * radius * radius) / 2].map((v) => +v.toPrecision(6));
  const geometry = `<cylinder><radius>${radius}</radius><length>${length}</length></cylinder>`;
  return model(name, length / 2, geometry, color, massKg, inertia);
}

export function sphere(
  radius: number,
  massKg: number,
  name = 'sphere',
  color = '0.8 0.3 0.35 1',
): Shape {
  const i = +(0.4 * massKg * radius * radius).toPrecision(6);
  return model(name, radius, `<sphere><radius>${radius}</radius></sphere>`, color, massKg, [
    i,
    i,
    i,
  ]);
}

export const SHAPES: Shape[] = [
  box(0.5, 0.5, 0.5, 5),
  // Named after "Cube 20k" of Gazebo's models, whose mesh has 20,000 triangles.
  box(0.5, 0.5, 0.5, 20, 'cube_20k', '0.75 0.75 0.78 1'),
  box(2, 0.15, 1, 60, 'barrier', '0.9 0.3 0.25 1'),
  cylinder(0.25, 1, 10),
  sphere(0.25, 2),
];
