//! Reader of the form that `pack_file` writes, for tests.

/// Content of the form.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Packed {
    pub(crate) has_linear_colours: bool,
    /// Kind (0 for a URI, 1 for an image) and bytes.
    pub(crate) textures: Vec<(u32, Vec<u8>)>,
    pub(crate) materials: Vec<PackedMaterial>,
    pub(crate) parts: Vec<PackedPart>,
}

#[derive(Debug, PartialEq)]
pub(crate) struct PackedMaterial {
    pub(crate) diffuse_rgba: [f32; 4],
    pub(crate) emissive_rgb: [f32; 3],
    pub(crate) cutoff: f32,
    pub(crate) flags: u32,
    pub(crate) texture: u32,
}

#[derive(Debug, PartialEq)]
pub(crate) struct PackedPart {
    pub(crate) name: String,
    pub(crate) material: u32,
    pub(crate) positions_m: Vec<[f32; 3]>,
    pub(crate) normals: Vec<[i16; 3]>,
    pub(crate) uvs: Vec<[f32; 2]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn bytes(&mut self, len: usize) -> &'a [u8] {
        let (bytes, rest) = self.0.split_at(len);
        self.0 = rest;
        bytes
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes(4).try_into().expect("four bytes"))
    }

    fn f32(&mut self) -> f32 {
        f32::from_bits(self.u32())
    }

    fn i16(&mut self) -> i16 {
        i16::from_le_bytes(self.bytes(2).try_into().expect("two bytes"))
    }

    fn block(&mut self) -> Vec<u8> {
        let len = self.u32() as usize;
        let block = self.bytes(len).to_vec();
        self.bytes(len.next_multiple_of(4) - len);
        block
    }
}

/// Reads all bytes; panics unless they are exactly one mesh.
pub(crate) fn unpack(bytes: &[u8]) -> Packed {
    let mut r = Reader(bytes);
    assert_eq!((r.bytes(4), r.u32()), (&b"PMSH"[..], 1));
    let has_linear_colours = r.u32() == 1;
    let [textures, materials, parts] = [r.u32(), r.u32(), r.u32()];
    let textures = (0..textures).map(|_| (r.u32(), r.block())).collect();
    let materials = (0..materials)
        .map(|_| PackedMaterial {
            diffuse_rgba: std::array::from_fn(|_| r.f32()),
            emissive_rgb: std::array::from_fn(|_| r.f32()),
            cutoff: r.f32(),
            flags: r.u32(),
            texture: r.u32(),
        })
        .collect();
    let parts = (0..parts).map(|_| part(&mut r)).collect();
    assert!(r.0.is_empty(), "{} bytes after the last part", r.0.len());
    Packed { has_linear_colours, textures, materials, parts }
}

fn part(r: &mut Reader<'_>) -> PackedPart {
    let name = String::from_utf8(r.block()).expect("UTF-8");
    let [material, flags, vertices, triangles] = [r.u32(), r.u32(), r.u32(), r.u32()];
    let positions_m = (0..vertices).map(|_| std::array::from_fn(|_| r.f32())).collect();
    let count = if flags & 1 == 0 { 0 } else { vertices };
    let normals: Vec<[i16; 3]> = (0..count).map(|_| std::array::from_fn(|_| r.i16())).collect();
    r.bytes(normals.len() % 2 * 2);
    let count = if flags & 2 == 0 { 0 } else { vertices };
    let uvs = (0..count).map(|_| std::array::from_fn(|_| r.f32())).collect();
    let is_long = flags & 4 != 0;
    let mut index = || if is_long { r.u32() } else { u32::from(r.i16().cast_unsigned()) };
    let triangles: Vec<[u32; 3]> =
        (0..triangles).map(|_| std::array::from_fn(|_| index())).collect();
    if !is_long {
        r.bytes(triangles.len() % 2 * 2);
    }
    PackedPart { name, material, positions_m, normals, uvs, triangles }
}
