//! Accessors: typed numbers in buffer views, read one index at a time, so that no count in the file becomes
//! an allocation.

use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor as Json, Index, Root};

use super::buffers::{Buffers, View, missing};
use crate::error::MeshError;
use crate::limits::Budget;

/// Validated accessor.
pub(super) struct Accessor {
    pub(super) count: usize,
    component: ComponentType,
    components: usize,
    normalized: bool,
    /// `None`: all zeros, except for sparse elements.
    view: Option<(View, Layout)>,
    sparse: Option<Sparse>,
}

#[derive(Clone, Copy)]
struct Layout {
    offset: usize,
    stride: usize,
}

/// Elements that replace those of the view; the specification requires strictly increasing indices.
struct Sparse {
    count: usize,
    indices: (View, Layout, ComponentType),
    values: (View, Layout),
}

impl Accessor {
    pub(super) fn new(
        root: &Root,
        buffers: &mut Buffers<'_>,
        budget: &mut Budget,
        index: Index<Json>,
    ) -> Result<Accessor, MeshError> {
        let at = index.value();
        let json = root.accessors.get(at).ok_or_else(|| missing("accessor", at))?;
        let (Checked::Valid(component), Checked::Valid(shape)) =
            (&json.component_type, &json.type_)
        else {
            return Err(damaged(at, "has an unknown type"));
        };
        let component = component.0;
        let components = match shape {
            Type::Scalar => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 => 4,
            Type::Mat2 | Type::Mat3 | Type::Mat4 => {
                return Err(damaged(at, "holds matrices where vectors are needed"));
            }
        };
        let count =
            usize::try_from(json.count.0).map_err(|_| damaged(at, "has an impossible count"))?;
        let size = components * component_size(component);
        let mut view = None;
        if let Some(index) = json.buffer_view {
            let offset = json.byte_offset.map_or(0, |offset| offset.0);
            let bytes = buffers.view(index, budget)?;
            view = Some(layout(at, bytes, offset, size, count)?);
        }
        let sparse = match &json.sparse {
            None => None,
            Some(sparse) => {
                let Checked::Valid(indices) = sparse.indices.component_type else {
                    return Err(damaged(at, "has sparse indices of an unknown type"));
                };
                let count = usize::try_from(sparse.count.0)
                    .map_err(|_| damaged(at, "has an impossible sparse count"))?;
                let index_view = buffers.view(sparse.indices.buffer_view, budget)?;
                let index_size = component_size(indices.0);
                let (index_view, index_layout) =
                    layout(at, index_view, sparse.indices.byte_offset.0, index_size, count)?;
                let value_view = buffers.view(sparse.values.buffer_view, budget)?;
                let values = layout(at, value_view, sparse.values.byte_offset.0, size, count)?;
                Some(Sparse { count, indices: (index_view, index_layout, indices.0), values })
            }
        };
        Ok(Accessor { count, component, components, normalized: json.normalized, view, sparse })
    }

    /// Returns true if there is no data for the count, so all elements are zero or sparse.
    pub(super) fn is_implied(&self) -> bool {
        self.view.is_none()
    }

    /// First `N` components at an index; `None` if the index is out of range or there are fewer components.
    pub(super) fn vector<const N: usize>(&self, index: usize) -> Option<[f64; N]> {
        if index >= self.count || self.components < N {
            return None;
        }
        let mut vector = [0.0; N];
        if let Some((view, at)) = self.element(index) {
            let size = component_size(self.component);
            for (i, x) in vector.iter_mut().enumerate() {
                *x = self.number(view.bytes().get(at + i * size..)?)?;
            }
        }
        Some(vector)
    }

    /// Integer at an index.
    pub(super) fn index(&self, index: usize) -> Option<usize> {
        let [x] = self.vector::<1>(index)?;
        // Every u32 is exact in an f64.
        (x >= 0.0 && x.fract() == 0.0).then_some(x as usize)
    }

    fn element(&self, index: usize) -> Option<(&View, usize)> {
        if let Some(sparse) = &self.sparse
            && let Some(at) = sparse.find(index)
        {
            return Some((&sparse.values.0, at));
        }
        let (view, layout) = self.view.as_ref()?;
        Some((view, layout.offset + index * layout.stride))
    }

    /// Section 3.6.2.2: normalized integers represent -1 to 1 or 0 to 1.
    fn number(&self, bytes: &[u8]) -> Option<f64> {
        let raw = raw_number(self.component, bytes)?;
        let full_scale = match self.component {
            _ if !self.normalized => return Some(raw),
            ComponentType::I8 => 127.0,
            ComponentType::U8 => 255.0,
            ComponentType::I16 => 32767.0,
            ComponentType::U16 => 65535.0,
            ComponentType::U32 | ComponentType::F32 => return Some(raw),
        };
        Some((raw / full_scale).max(-1.0))
    }
}

impl Sparse {
    /// Offset of the replacing element, by bisection.
    fn find(&self, index: usize) -> Option<usize> {
        let (view, layout, component) = &self.indices;
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            let at = layout.offset + middle * layout.stride;
            let found = raw_number(*component, view.bytes().get(at..)?)? as usize;
            match found.cmp(&index) {
                std::cmp::Ordering::Equal => {
                    return Some(self.values.1.offset + middle * self.values.1.stride);
                }
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}

/// Checks that `count` elements fit into the view.
fn layout(
    accessor: usize,
    view: View,
    offset: u64,
    size: usize,
    count: usize,
) -> Result<(View, Layout), MeshError> {
    let stride = view.stride.unwrap_or(size);
    let end = || {
        let offset = usize::try_from(offset).ok()?;
        let last = count
            .checked_sub(1)
            .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        Some((offset, offset.checked_add(last?)?))
    };
    match end() {
        Some((offset, end)) if end <= view.bytes().len() => Ok((view, Layout { offset, stride })),
        _ => Err(damaged(accessor, &format!("counts {count} elements, more than its data holds"))),
    }
}

fn component_size(component: ComponentType) -> usize {
    match component {
        ComponentType::I8 | ComponentType::U8 => 1,
        ComponentType::I16 | ComponentType::U16 => 2,
        ComponentType::U32 | ComponentType::F32 => 4,
    }
}

fn raw_number(component: ComponentType, bytes: &[u8]) -> Option<f64> {
    let two = || bytes.first_chunk().copied();
    let four = || bytes.first_chunk().copied();
    Some(match component {
        ComponentType::I8 => f64::from(i8::from_le_bytes([*bytes.first()?])),
        ComponentType::U8 => f64::from(*bytes.first()?),
        ComponentType::I16 => f64::from(i16::from_le_bytes(two()?)),
        ComponentType::U16 => f64::from(u16::from_le_bytes(two()?)),
        ComponentType::U32 => f64::from(u32::from_le_bytes(four()?)),
        ComponentType::F32 => f64::from(f32::from_le_bytes(bytes.first_chunk().copied()?)),
    })
}

fn damaged(accessor: usize, what: &str) -> MeshError {
    MeshError::new(format!("accessor {accessor} {what}"), "the file is damaged: export it again")
}
