//! Scene: nodes with their transforms and meshes.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use ::gltf::json::{Index, Node, Root, mesh, scene};
use glam::{DMat4, DQuat, DVec3, DVec4};

use super::buffers::{Buffers, missing};
use super::{material, primitive};
use crate::build::Part;
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::{MeshMaterial, Submesh};
use crate::notes::Notes;

/// State of the traversal.
pub(super) struct Walk<'a> {
    root: &'a Root,
    buffers: Buffers<'a>,
    budget: &'a mut Budget,
    notes: &'a mut Notes,
    /// Meshes read so far; further instances are charged.
    meshes: BTreeMap<usize, Rc<Vec<Primitive>>>,
    materials: BTreeMap<usize, Option<Arc<MeshMaterial>>>,
    unnamed: usize,
    pub(super) submeshes: Vec<Submesh>,
}

struct Primitive {
    part: Part,
    material: Option<Arc<MeshMaterial>>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        root: &'a Root,
        buffers: Buffers<'a>,
        budget: &'a mut Budget,
        notes: &'a mut Notes,
    ) -> Self {
        let (meshes, materials) = (BTreeMap::new(), BTreeMap::new());
        Walk { root, buffers, budget, notes, meshes, materials, unnamed: 0, submeshes: Vec::new() }
    }

    /// Adds the default scene, or the first one, or in a file without scenes every root node.
    pub(super) fn default_scene(&mut self) -> Result<(), MeshError> {
        let root = self.root;
        let scene = match root.scene {
            Some(index) => Some(
                root.scenes.get(index.value()).ok_or_else(|| missing("scene", index.value()))?,
            ),
            None => root.scenes.first(),
        };
        if let Some(scene) = scene {
            return scene.nodes.iter().try_for_each(|&node| self.node(node, DMat4::IDENTITY, 0));
        }
        let mut is_child = vec![false; root.nodes.len()];
        for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
            if let Some(is_child) = is_child.get_mut(child.value()) {
                *is_child = true;
            }
        }
        for (i, _) in is_child.iter().enumerate().filter(|(_, is_child)| !**is_child) {
            let index = u32::try_from(i).map_err(|_| missing("node", i))?;
            self.node(Index::new(index), DMat4::IDENTITY, 0)?;
        }
        Ok(())
    }

    fn node(
        &mut self,
        index: Index<scene::Node>,
        mesh_from_parent: DMat4,
        depth: usize,
    ) -> Result<(), MeshError> {
        self.budget.visit()?;
        self.budget.depth(depth)?;
        let root = self.root;
        let node = root.nodes.get(index.value());
        let node = node.ok_or_else(|| missing("node", index.value()))?;
        let mesh_from_node = mesh_from_parent * parent_from_node(node);
        if !mesh_from_node.is_finite() {
            return Err(MeshError::new(
                format!("the transform of node {} is not finite", index.value()),
                "repair the scene and export it again",
            ));
        }
        if node.skin.is_some() {
            self.notes.add("skin loaded in its bind pose, without animation");
        }
        if let Some(mesh) = node.mesh {
            self.mesh(mesh, node, mesh_from_node)?;
        }
        node.children
            .iter()
            .flatten()
            .try_for_each(|&child| self.node(child, mesh_from_node, depth + 1))
    }

    fn mesh(
        &mut self,
        index: Index<mesh::Mesh>,
        node: &Node,
        mesh_from_node: DMat4,
    ) -> Result<(), MeshError> {
        let root = self.root;
        let mesh = root.meshes.get(index.value());
        let mesh = mesh.ok_or_else(|| missing("mesh", index.value()))?;
        let known = self.meshes.get(&index.value()).map(Rc::clone);
        let is_first = known.is_none();
        let primitives = match known {
            Some(primitives) => primitives,
            None => {
                let primitives = Rc::new(self.primitives(mesh)?);
                self.meshes.insert(index.value(), Rc::clone(&primitives));
                primitives
            }
        };
        for Primitive { part, material } in primitives.iter() {
            if !is_first {
                part.charge_copy(self.budget)?;
            }
            let named = [&node.name, &mesh.name].into_iter().flatten().find(|n| !n.is_empty());
            let name = named.cloned().unwrap_or_else(|| {
                self.unnamed += 1;
                format!("unnamed_submesh_{}", self.unnamed - 1)
            });
            self.budget.bytes(name.len())?;
            let placed = part.placed(name, material.clone(), mesh_from_node, self.notes)?;
            self.submeshes.push(placed);
        }
        Ok(())
    }

    fn primitives(&mut self, mesh: &mesh::Mesh) -> Result<Vec<Primitive>, MeshError> {
        let mut primitives = Vec::new();
        for json in &mesh.primitives {
            let Walk { root, buffers, budget, notes, .. } = self;
            let part = primitive::read(root, json, buffers, budget, notes)?;
            if part.is_empty() {
                continue;
            }
            let material = match json.material {
                None => None,
                Some(index) => match self.materials.get(&index.value()) {
                    Some(known) => known.clone(),
                    None => {
                        let new = material::read(root, index, buffers, budget, notes)?;
                        self.materials.insert(index.value(), new.clone());
                        new
                    }
                },
            };
            primitives.push(Primitive { part, material });
        }
        Ok(primitives)
    }
}

/// Section 3.5.3: a matrix, or translation * rotation * scale.
fn parent_from_node(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let scale = vector(node.scale.unwrap_or([1.0; 3]));
    let translation = vector(node.translation.unwrap_or_default());
    let rotation = node.rotation.map_or(DVec4::W, |q| DVec4::from_array(q.0.map(f64::from)));
    // A zero quaternion is not a rotation.
    let rotation = rotation.try_normalize().unwrap_or(DVec4::W);
    DMat4::from_scale_rotation_translation(scale, DQuat::from_vec4(rotation), translation)
}
