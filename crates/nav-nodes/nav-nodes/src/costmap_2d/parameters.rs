//! Parameters of a costmap node: those of the costmap, of its layers and of their sources.

use periplus_costmap::{CostmapConfig, LayerConfig};
use periplus_params::ParamValues;

/// Returns all parameters of a costmap, with names such as `obstacle_layer.scan.topic`.
#[must_use]
pub fn node_values(config: &CostmapConfig) -> ParamValues {
    fn add(layers: &[LayerConfig], values: &mut ParamValues) {
        for layer in layers {
            values.add_group(&layer.name, layer.values.clone());
            for source in &layer.sources {
                values.add_group(source_group(&layer.name, &source.name), source.values.clone());
            }
            add(&layer.children, values);
        }
    }
    let mut values = config.node.clone();
    add(&config.layers, &mut values);
    add(&config.filters, &mut values);
    values
}

/// Group of the parameters of an observation source.
pub(crate) fn source_group(layer: &str, source: &str) -> String {
    format!("{layer}.{source}")
}

/// Returns the parameters of one group from all parameters, such as `inflation_layer`, or those of the
/// costmap for an empty name. Values that do not differ from `usual` keep their source locations.
#[must_use]
pub fn split(all: &ParamValues, group: &str, usual: &ParamValues) -> ParamValues {
    let mut values = usual.clone();
    let Some(part) = all.group(group) else { return values };
    for name in usual.table().names() {
        if let Some(value) = part.get(name)
            && usual.get(name).as_ref() != Some(&value)
        {
            values.set(name, value);
        }
    }
    values
}
