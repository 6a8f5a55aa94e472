//! Visual scene: nodes and instances in the mesh frame.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use glam::DMat4;

use super::plan::{Item, Plan, Planner, Shape};
use super::tree::Node;
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::Submesh;

/// State of the traversal.
pub(super) struct Walk<'t, 'b> {
    planner: Planner<'t>,
    budget: &'b mut Budget,
    plans: BTreeMap<u32, Rc<Plan<'t>>>,
    /// Geometries placed before, by address: further instances are charged.
    placed: BTreeSet<*const Vec<super::geometry::Primitive>>,
    unnamed: usize,
    pub(super) submeshes: Vec<Submesh>,
}

/// Position of a node in the tree.
#[derive(Clone, Copy)]
struct Branch<'t> {
    mesh_from_node: DMat4,
    /// Name of the node or its nearest ancestor that has one.
    name: Option<&'t str>,
    depth: usize,
}

impl<'t, 'b> Walk<'t, 'b> {
    pub(super) fn new(planner: Planner<'t>, budget: &'b mut Budget) -> Self {
        let (plans, placed) = (BTreeMap::new(), BTreeSet::new());
        Walk { planner, budget, plans, placed, unnamed: 0, submeshes: Vec::new() }
    }

    /// Adds all content of a `<visual_scene>`.
    pub(super) fn scene(
        &mut self,
        scene: Node<'t>,
        mesh_from_scene: DMat4,
    ) -> Result<(), MeshError> {
        let branch = Branch { mesh_from_node: mesh_from_scene, name: None, depth: 0 };
        scene.children_named("node").try_for_each(|node| self.node(node, branch))
    }

    /// Adds a geometry outside any scene, for files without a scene.
    pub(super) fn lone(
        &mut self,
        geometry: Node<'t>,
        mesh_from_file: DMat4,
    ) -> Result<(), MeshError> {
        let shape = self.planner.shape(geometry, None, DMat4::IDENTITY, self.budget)?;
        let name = geometry.attribute("name");
        self.shape(&shape, Branch { mesh_from_node: mesh_from_file, name, depth: 0 })
    }

    fn node(&mut self, node: Node<'t>, parent: Branch<'t>) -> Result<(), MeshError> {
        self.budget.visit()?;
        self.budget.depth(parent.depth)?;
        let plan = match self.plans.get(&node.id()) {
            Some(plan) => Rc::clone(plan),
            None => {
                let plan = Rc::new(self.planner.node(node, self.budget)?);
                self.plans.insert(node.id(), Rc::clone(&plan));
                plan
            }
        };
        let branch = Branch {
            mesh_from_node: parent.mesh_from_node * plan.parent_from_node,
            name: plan.name.or(parent.name),
            depth: parent.depth + 1,
        };
        plan.items.iter().try_for_each(|item| match item {
            Item::Node(node) => self.node(*node, branch),
            Item::Shape(shape) => self.shape(shape, branch),
        })
    }

    fn shape(&mut self, shape: &Shape, branch: Branch<'t>) -> Result<(), MeshError> {
        self.budget.visit()?;
        let is_first = self.placed.insert(Rc::as_ptr(&shape.primitives));
        let mesh_from_shape = branch.mesh_from_node * shape.node_from_shape;
        for (primitive, material) in shape.primitives.iter().zip(&shape.materials) {
            if !is_first {
                primitive.part.charge_copy(self.budget)?;
            }
            let name = branch.name.map_or_else(|| self.next_unnamed(), str::to_owned);
            self.budget.bytes(name.len())?;
            let notes = &mut *self.planner.notes;
            let placed = primitive.part.placed(name, material.clone(), mesh_from_shape, notes)?;
            self.submeshes.push(placed);
        }
        Ok(())
    }

    /// Name that Gazebo generates for an unnamed part, counted per file.
    fn next_unnamed(&mut self) -> String {
        self.unnamed += 1;
        format!("unnamed_submesh_{}", self.unnamed - 1)
    }
}
