//! `<source>`: arrays of numbers and their accessors.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::tree::{Node, short};
use crate::error::MeshError;

/// Parsed number arrays by element, so that shared arrays are parsed once.
#[derive(Default)]
pub(super) struct Arrays(BTreeMap<u32, Rc<Vec<f64>>>);

/// `N` numbers per index.
#[derive(Clone)]
pub(super) struct Source<const N: usize> {
    numbers: Rc<Vec<f64>>,
    offset: usize,
    stride: usize,
    /// Offset of each component within one stride.
    components: [usize; N],
}

impl<const N: usize> Source<N> {
    /// Reads the source of an `input`.
    pub(super) fn of(input: Node<'_>, arrays: &mut Arrays) -> Result<Source<N>, MeshError> {
        let url = input.attribute("source").unwrap_or("");
        let Some(source) = input.tree().find("source", url) else {
            return Err(input.error(format!("no `<source>` has the id `{}`", short(url))));
        };
        let Some(accessor) = source.descend(&["technique_common", "accessor"]) else {
            return Err(source.error("has no `<technique_common><accessor>`"));
        };
        let array = accessor
            .attribute("source")
            .and_then(|url| source.tree().find("float_array", url))
            .or_else(|| source.child("float_array"));
        let Some(array) = array else { return Err(source.error("has no `<float_array>`")) };
        let stride = accessor.count("stride", 1)?;
        let numbers = match arrays.0.get(&array.id()) {
            Some(numbers) => Rc::clone(numbers),
            None => {
                let numbers = Rc::new(array.numbers()?);
                arrays.0.insert(array.id(), Rc::clone(&numbers));
                numbers
            }
        };
        let components = components(accessor, stride)?;
        Ok(Source { numbers, offset: accessor.count("offset", 0)?, stride, components })
    }

    /// Numbers at an index, if it is in range.
    pub(super) fn get(&self, index: u32) -> Option<[f64; N]> {
        let start = usize::try_from(index).ok()?.checked_mul(self.stride)?;
        let start = start.checked_add(self.offset)?;
        let mut values = [0.0; N];
        for (value, component) in values.iter_mut().zip(self.components) {
            *value = *self.numbers.get(start.checked_add(component)?)?;
        }
        Some(values)
    }

    /// Number of valid indices, for a message.
    pub(super) fn len(&self) -> usize {
        self.numbers.len().saturating_sub(self.offset) / self.stride.max(1)
    }
}

/// A `<param>` without a name is skipped (COLLADA 1.4.1, 5-25).
fn components<const N: usize>(accessor: Node<'_>, stride: usize) -> Result<[usize; N], MeshError> {
    let named = accessor.children_named("param").enumerate();
    let mut named =
        named.filter(|(_, param)| param.attribute("name").is_some_and(|n| !n.is_empty()));
    let mut components = std::array::from_fn(|i| i);
    let wanted: Vec<usize> = named.by_ref().take(N).map(|(i, _)| i).collect();
    // Without any named parameter the first ones are used.
    if wanted.len() == N {
        components.copy_from_slice(&wanted);
    }
    if components.iter().any(|&component| component >= stride) {
        return Err(accessor.error(format!("stride {stride} is too small for {N} numbers")));
    }
    Ok(components)
}
