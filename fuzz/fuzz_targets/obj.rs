//! OBJ with an MTL file: no input panics, and what is read is sound.

#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_meshes::MeshFormat;

#[path = "../mesh_checks.rs"]
mod mesh_checks;

fuzz_target!(|bytes: &[u8]| mesh_checks::read_and_check(bytes, MeshFormat::Obj));
