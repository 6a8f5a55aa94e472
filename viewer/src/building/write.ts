/** Writer of buildings as SDF files, in the structure of Gazebo's Building Editor. */
import { MATERIALS, type Plan } from './plan';
import { bounds, partsOf, type Box, type Part } from './solid';

/** Shortest form of a number rounded to a hundredth of a millimetre. */
export function num(value: number): string {
  const text = value.toFixed(5).replace(/\.?0+$/, '');
  return text === '-0' ? '0' : text;
}

const escape = (text: string) => text.replace(/[<>&"']/g, (c) => `&#${c.charCodeAt(0)};`);

function geometry(box: Box, indent: string): string {
  const size = [box.sizeX, box.sizeY, box.sizeZ].map(num).join(' ');
  return (
    `${indent}<pose>${num(box.x)} ${num(box.y)} ${num(box.z)} 0 0 0</pose>\n` +
    `${indent}<geometry>\n${indent}  <box>\n${indent}    <size>${size}</size>\n${indent}  </box>\n${indent}</geometry>\n`
  );
}

function linkText(part: Part, offset: { x: number; y: number }): string {
  const color = (MATERIALS[part.material] ?? [0.7, 0.7, 0.7]).map(num).join(' ');
  const pose = `${num(part.at.x - offset.x)} ${num(part.at.y - offset.y)} ${num(part.baseM)} 0 0 ${num(part.yawRad)}`;
  const many = part.boxes.length > 1;
  const inner = part.boxes.map((box, i) => {
    const name = (what: string) => `${part.name}_${what}${many ? `_${i}` : ''}`;
    return (
      `      <collision name="${name('Collision')}">\n${geometry(box, '        ')}      </collision>\n` +
      `      <visual name="${name('Visual')}">\n${geometry(box, '        ')}` +
      `        <material>\n          <script>\n` +
      `            <uri>file://media/materials/scripts/gazebo.material</uri>\n` +
      `            <name>${escape(part.material)}</name>\n          </script>\n` +
      `          <ambient>${color} 1</ambient>\n          <diffuse>${color} 1</diffuse>\n        </material>\n` +
      `        <meta>\n          <layer>${part.level}</layer>\n        </meta>\n      </visual>\n`
    );
  });
  return `    <link name="${part.name}">\n      <pose>${pose}</pose>\n${inner.join('')}    </link>\n`;
}

/** The `<model>` element without the header of a file. */
function modelText(plan: Plan): string {
  const { min, max } = bounds(plan);
  const middle = { x: (min.x + max.x) / 2, y: (min.y + max.y) / 2 };
  const links = partsOf(plan).map((part) => linkText(part, middle));
  return (
    `  <model name="${escape(plan.name)}">\n` +
    `    <pose>${num(middle.x)} ${num(middle.y)} 0 0 0 0</pose>\n` +
    `${links.join('')}    <static>1</static>\n  </model>\n`
  );
}

export function modelSdf(plan: Plan): string {
  return `<?xml version="1.0"?>\n<sdf version="1.6">\n${modelText(plan)}</sdf>\n`;
}

export function modelConfig(plan: Plan): string {
  return (
    `<?xml version="1.0"?>\n<model>\n  <name>${escape(plan.name)}</name>\n  <version>1.0</version>\n` +
    `  <sdf version="1.6">model.sdf</sdf>\n  <author>\n    <name>${escape(plan.author)}</name>\n` +
    `    <email></email>\n  </author>\n  <description></description>\n</model>\n`
  );
}

/** A world with a sun, a ground plane and the building. */
export function worldSdf(plan: Plan): string {
  const indented = modelText(plan).replace(/^(?=.)/gm, '  ');
  return (
    `<?xml version="1.0"?>\n<sdf version="1.6">\n  <world name="${escape(plan.name)}_world">\n` +
    `    <light type="directional" name="sun">\n      <cast_shadows>1</cast_shadows>\n` +
    `      <pose>0 0 10 0 0 0</pose>\n      <diffuse>0.8 0.8 0.8 1</diffuse>\n` +
    `      <specular>0.2 0.2 0.2 1</specular>\n      <direction>-0.5 0.1 -0.9</direction>\n    </light>\n` +
    `    <model name="ground_plane">\n      <static>1</static>\n      <link name="link">\n` +
    `        <collision name="collision">\n          <geometry>\n            <plane>\n` +
    `              <normal>0 0 1</normal>\n              <size>100 100</size>\n            </plane>\n` +
    `          </geometry>\n        </collision>\n        <visual name="visual">\n          <geometry>\n` +
    `            <plane>\n              <normal>0 0 1</normal>\n              <size>100 100</size>\n` +
    `            </plane>\n          </geometry>\n          <material>\n` +
    `            <ambient>0.6 0.62 0.6 1</ambient>\n            <diffuse>0.6 0.62 0.6 1</diffuse>\n` +
    `          </material>\n        </visual>\n      </link>\n    </model>\n${indented}  </world>\n</sdf>\n`
  );
}
