//! Content of a `<node>`, computed once for all of its instances.
//!
//! A small file can instantiate a large node a million times; this limits the cost of each further instance
//! to its share of the budget.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use glam::DMat4;

use super::geometry::{self, Context, Primitive};
use super::source::Arrays;
use super::tree::{Node, Tree, short};
use super::{material, transform};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::MeshMaterial;
use crate::notes::Notes;

/// Node with resolved content.
pub(super) struct Plan<'t> {
    pub(super) parent_from_node: DMat4,
    pub(super) name: Option<&'t str>,
    pub(super) items: Vec<Item<'t>>,
}

/// Item of a node, in document order.
pub(super) enum Item<'t> {
    /// Child node, or instance of another node.
    Node(Node<'t>),
    /// Instance of a geometry, possibly through a controller.
    Shape(Shape),
}

/// Geometry with the materials of this instance.
pub(super) struct Shape {
    pub(super) primitives: Rc<Vec<Primitive>>,
    /// One per primitive.
    pub(super) materials: Vec<Option<Arc<MeshMaterial>>>,
    /// Bind shape matrix of a skin; else the identity.
    pub(super) node_from_shape: DMat4,
}

/// Creates plans; reads each geometry and material once.
pub(super) struct Planner<'t> {
    tree: &'t Tree<'t>,
    pub(super) notes: &'t mut Notes,
    arrays: Arrays,
    geometries: BTreeMap<u32, Rc<Vec<Primitive>>>,
    materials: BTreeMap<u32, Arc<MeshMaterial>>,
}

impl<'t> Planner<'t> {
    pub(super) fn new(tree: &'t Tree<'t>, notes: &'t mut Notes) -> Self {
        let (geometries, materials) = (BTreeMap::new(), BTreeMap::new());
        Planner { tree, notes, arrays: Arrays::default(), geometries, materials }
    }

    pub(super) fn node(
        &mut self,
        node: Node<'t>,
        budget: &mut Budget,
    ) -> Result<Plan<'t>, MeshError> {
        let mut items = Vec::new();
        for child in node.children() {
            match child.tag() {
                "node" => items.push(Item::Node(child)),
                "instance_node" => items.extend(self.target("node", child).map(Item::Node)),
                "instance_geometry" => {
                    if let Some(geometry) = self.target("geometry", child) {
                        let shape = self.shape(geometry, Some(child), DMat4::IDENTITY, budget)?;
                        items.push(Item::Shape(shape));
                    }
                }
                "instance_controller" => {
                    items.extend(self.controller(child, budget)?.map(Item::Shape));
                }
                _ => {}
            }
        }
        let parent_from_node = transform::parent_from_node(node, self.notes)?;
        let name = node.attribute("name").filter(|name| !name.is_empty());
        Ok(Plan { parent_from_node, name, items })
    }

    /// Target of an instance; a missing one only loses the instance.
    fn target(&mut self, tag: &str, instance: Node<'t>) -> Option<Node<'t>> {
        let url = instance.attribute("url").unwrap_or("");
        let target = self.tree.find(tag, url);
        if target.is_none() {
            let why = if url.contains('#') && !url.starts_with('#') {
                "is in another file, which is not read: merge the files"
            } else {
                "is not in the file"
            };
            self.notes.add(format!("`<{}>` left out: `{}` {why}", instance.tag(), short(url)));
        }
        target
    }

    /// A skinned mesh is in its bind pose: the geometry is transformed by the bind shape matrix, then by
    /// the node. A morphed one keeps its base shape.
    fn controller(
        &mut self,
        instance: Node<'t>,
        budget: &mut Budget,
    ) -> Result<Option<Shape>, MeshError> {
        let Some(mut controller) = self.target("controller", instance) else { return Ok(None) };
        let mut node_from_shape = DMat4::IDENTITY;
        for depth in 0.. {
            budget.depth(depth)?;
            let skin = controller.child("skin");
            let Some(deformer) = skin.or_else(|| controller.child("morph")) else { break };
            if let Some(element) = deformer.child("bind_shape_matrix") {
                node_from_shape *= transform::matrix(element)?;
            }
            let url = deformer.attribute("source").unwrap_or("");
            if let Some(geometry) = self.tree.find("geometry", url) {
                self.notes.add("skin or morph target loaded in its bind pose, without animation");
                return self.shape(geometry, Some(instance), node_from_shape, budget).map(Some);
            }
            match self.tree.find("controller", url) {
                Some(next) => controller = next,
                None => break,
            }
        }
        self.notes.add("controller without a geometry in this file left out");
        Ok(None)
    }

    pub(super) fn shape(
        &mut self,
        geometry: Node<'t>,
        instance: Option<Node<'t>>,
        node_from_shape: DMat4,
        budget: &mut Budget,
    ) -> Result<Shape, MeshError> {
        let bound = bindings(instance);
        let primitives = match self.geometries.get(&geometry.id()) {
            Some(primitives) => Rc::clone(primitives),
            None => {
                let Planner { arrays, notes, .. } = self;
                let mut context = Context { arrays, budget, notes };
                let primitives = Rc::new(geometry::read(geometry, &mut context)?);
                self.geometries.insert(geometry.id(), Rc::clone(&primitives));
                primitives
            }
        };
        let mut materials = Vec::new();
        for primitive in primitives.iter() {
            budget.visit()?;
            let symbol = primitive.material_symbol.as_deref();
            budget.bytes(symbol.map_or(0, str::len))?;
            materials.push(match symbol {
                Some(symbol) => self.material(symbol, &bound, budget)?,
                None => None,
            });
        }
        Ok(Shape { primitives, materials, node_from_shape })
    }

    fn material(
        &mut self,
        symbol: &str,
        bound: &BTreeMap<&str, &str>,
        budget: &mut Budget,
    ) -> Result<Option<Arc<MeshMaterial>>, MeshError> {
        // Symbols without a binding that are the id of a material refer to it, as in Gazebo.
        let target = bound.get(symbol).copied().unwrap_or(symbol);
        let Some(node) = self.tree.find("material", target) else {
            self.notes.add(format!("material `{}` is bound to nothing", short(symbol)));
            return Ok(None);
        };
        if let Some(known) = self.materials.get(&node.id()) {
            return Ok(Some(Arc::clone(known)));
        }
        let material = Arc::new(material::read(node));
        budget.bytes(material.size_bytes())?;
        self.materials.insert(node.id(), Arc::clone(&material));
        Ok(Some(material))
    }
}

/// Material symbols that an instance binds, with the URL of the material.
fn bindings(instance: Option<Node<'_>>) -> BTreeMap<&str, &str> {
    instance
        .into_iter()
        .flat_map(|instance| instance.children_named("bind_material"))
        .filter_map(|binding| binding.child("technique_common"))
        .flat_map(|technique| technique.children_named("instance_material"))
        .filter_map(|binding| Some((binding.attribute("symbol")?, binding.attribute("target")?)))
        .collect()
}
