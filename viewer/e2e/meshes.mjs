// Meshes of every format in the picture: the server reads the files, the page draws their triangles and textures.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { open, periplus, until, port } from './lib.mjs';

const PORT = port(8867);

/** Eight by eight pixels: the upper half is red, the lower half green. */
const PNG = Buffer.from(
  'iVBORw0KGgoAAAANSUhEUgAAAAgAAAAICAIAAABLbSncAAAAFUlEQVR42mP4z8CAFTFQUYKB9pYAAAkfP8ExgAucAAAAAElFTkSuQmCC',
  'base64',
);

/** A square of one metre around the origin that faces up: corners and texture coordinates, v upwards. */
const CORNERS = [
  [-0.5, -0.5, 0, 0, 0],
  [0.5, -0.5, 0, 1, 0],
  [0.5, 0.5, 0, 1, 1],
  [-0.5, 0.5, 0, 0, 1],
];
const floats = (values) => Buffer.from(new Float32Array(values.flat()).buffer);
const POSITIONS = CORNERS.map((c) => c.slice(0, 3));
const TRIANGLES = [0, 1, 2, 0, 2, 3];

function gltf(image, buffers, views = []) {
  return {
    asset: { version: '2.0' },
    nodes: [{ mesh: 0 }],
    meshes: [
      {
        primitives: [
          { attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, indices: 3, material: 0 },
        ],
      },
    ],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }],
    images: [image],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        count: 4,
        type: 'VEC3',
        min: [-0.5, -0.5, 0],
        max: [0.5, 0.5, 0],
      },
      { bufferView: 1, componentType: 5126, count: 4, type: 'VEC3' },
      { bufferView: 2, componentType: 5126, count: 4, type: 'VEC2' },
      { bufferView: 3, componentType: 5123, count: 6, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 48 },
      { buffer: 0, byteOffset: 96, byteLength: 32 },
      { buffer: 0, byteOffset: 128, byteLength: 12 },
      ...views,
    ],
    buffers,
  };
}

const BIN = Buffer.concat([
  floats(POSITIONS),
  floats(CORNERS.map(() => [0, 0, 1])),
  // In glTF v points down.
  floats(CORNERS.map(([, , , u, v]) => [u, 1 - v])),
  Buffer.from(new Uint16Array(TRIANGLES).buffer),
]);

function glb() {
  const bin = Buffer.concat([BIN, PNG, Buffer.alloc(-(BIN.length + PNG.length) & 3)]);
  const image = { bufferView: 4, mimeType: 'image/png' };
  const view = { buffer: 0, byteOffset: BIN.length, byteLength: PNG.length };
  const text = JSON.stringify(gltf(image, [{ byteLength: bin.length }], [view]));
  const json = Buffer.from(text.padEnd(Math.ceil(text.length / 4) * 4));
  const head = Buffer.alloc(20);
  head.write('glTF');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(28 + json.length + bin.length, 8);
  head.writeUInt32LE(json.length, 12);
  head.write('JSON', 16);
  const second = Buffer.alloc(8);
  second.writeUInt32LE(bin.length);
  second.write('BIN\0', 4);
  return Buffer.concat([head, json, second, bin]);
}

const OBJ = `mtllib square.mtl
${CORNERS.map(([x, y, z]) => `v ${x} ${y} ${z}`).join('\n')}
${CORNERS.map(([, , , u, v]) => `vt ${u} ${v}`).join('\n')}
vn 0 0 1
o square
usemtl painted
f 1/1/1 2/2/1 3/3/1 4/4/1
o far
v 90 0 0
v 91 0 0
v 91 1 0
v 90 1 0
f 5/1/1 6/2/1 7/3/1 8/4/1
`;

const source = (id, values, names) =>
  `<source id="${id}"><float_array id="${id}a" count="${values.length}">${values.join(' ')}</float_array>
  <technique_common><accessor source="#${id}a" count="4" stride="${names.length}"/></technique_common></source>`;
const DAE = `<COLLADA version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
  <library_images><image id="i"><init_from>square.png</init_from></image></library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam>
    <technique sid="c"><lambert><diffuse><texture texture="s" texcoord="t"/></diffuse></lambert></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    ${source('p', POSITIONS.flat(), 'xyz')}
    ${source('t', CORNERS.map((c) => c.slice(3)).flat(), 'st')}
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="2" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#t" offset="0"/><p>${TRIANGLES.join(' ')}</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="w"><node name="square"><instance_geometry url="#g">
    <bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material>
  </instance_geometry></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#w"/></scene></COLLADA>`;

const STL = `solid square
${[TRIANGLES.slice(0, 3), TRIANGLES.slice(3)]
  .map(
    (corners) =>
      `facet normal 0 0 0\nouter loop\n${corners
        .map((i) => `vertex ${POSITIONS[i].join(' ')}`)
        .join('\n')}\nendloop\nendfacet`,
  )
  .join('\n')}
endsolid square
`;

/** Models in a row, two metres apart, and whether they have the texture. */
const MODELS = [
  ['square.obj#square', true],
  ['square.dae', true],
  ['square.glb', true],
  ['square.gltf', true],
  ['square.stl', false],
];

function write(folder) {
  const put = (name, content) => writeFileSync(join(folder, name), content);
  put('square.png', PNG);
  put('square.mtl', 'newmtl painted\nKd 1 1 1\nmap_Kd square.png\n');
  put('square.obj', OBJ);
  put('square.dae', DAE);
  put('square.stl', STL);
  put('square.bin', BIN);
  put(
    'square.gltf',
    JSON.stringify(gltf({ uri: 'square.png' }, [{ byteLength: 140, uri: 'square.bin' }])),
  );
  put('square.glb', glb());
  const models = MODELS.map(([uri], i) => {
    const [file, part] = uri.split('#');
    const submesh = part ? `<submesh><name>${part}</name><center>true</center></submesh>` : '';
    return `<model name="m${i}"><static>1</static><pose>${2 * i} 0 1 0 0 0</pose><link name="l"><visual name="v">
      <geometry><mesh><uri>${file}</uri>${submesh}</mesh></geometry></visual></link></model>`;
  });
  const world = join(folder, 'meshes.sdf');
  writeFileSync(
    world,
    `<sdf version="1.9"><world name="meshes">${models.join('\n')}</world></sdf>`,
  );
  return world;
}

/** Colours of the 3D view at points of the world. */
async function colors(page, points) {
  const png = await page.locator('canvas').first().screenshot();
  return page.evaluate(
    async ([bytes, all]) => {
      const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      const { scene, view } = window.periplus.stage;
      return all.map((point) => {
        const { x, y } = scene.position
          .clone()
          .set(...point)
          .project(view.camera);
        const at = [((x + 1) / 2) * image.width, ((1 - y) / 2) * image.height];
        return [...context.getImageData(...at.map(Math.round), 1, 1).data].slice(0, 3);
      });
    },
    [[...png], points],
  );
}

const isRed = ([r, g, b]) => r > 90 && g < 70 && b < 70;
const isGreen = ([r, g, b]) => g > 90 && r < 70 && b < 70;
const isGrey = ([r, g, b]) => r > 60 && Math.max(r, g, b) - Math.min(r, g, b) < 40;

export async function meshes(chrome, url, out, attempt) {
  await attempt('meshes', async () => {
    const world = write(out);
    const run = await periplus(
      ['sim', world, '--rtf', '1', '--ros2', 'off', `--page=127.0.0.1:${PORT}`],
      PORT,
    );
    const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
    try {
      const display = 'periplus.displays.find((d) => d.kind.title === "World")';
      await until(page, `${display}?.statuses.Scene?.text.startsWith("5 ")`, 'five shapes');
      const loaded = `(() => { let n = 0; ${display}.display.root.traverse((o) => (n += o.isMesh ? 1 : 0)); return n; })()`;
      await until(
        page,
        `${loaded} === 5`,
        'five meshes: of the OBJ only the part that the world names',
      );
      await page.evaluate(() => {
        const { view } = window.periplus.stage;
        view.set({ ...view.state, kind: 'TopDownOrtho', x: 4, y: 0, angle: 0, scale: 50 });
        window.periplus.stage.invalidate();
      });
      await page.waitForTimeout(1000);
      const points = MODELS.flatMap((_, i) => [
        [2 * i, 0.25, 1],
        [2 * i, -0.25, 1],
      ]);
      const found = await colors(page, points);
      MODELS.forEach(([uri, isPainted], i) => {
        const [upper, lower] = [found[2 * i], found[2 * i + 1]];
        const holds = isPainted ? isRed(upper) && isGreen(lower) : isGrey(upper) && isGrey(lower);
        assert.ok(holds, `${uri}: ${upper} above ${lower}`);
      });
      assert.equal(await page.evaluate(`${display}.level`), 'ok');
      assert.deepEqual(complaints, []);
    } finally {
      await page.close();
      await run.stop();
    }
  });
}
