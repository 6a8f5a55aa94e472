//! Labels for segmentation.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Plugin;

/// Returns the label from the plugins of a visual or model (gz-sim's `Label` system), 0 to 255.
pub(crate) fn label_of(plugins: &[Plugin], diagnostics: &mut Diagnostics) -> Option<u8> {
    let plugin = plugins.iter().find(|plugin| is_label_plugin(plugin))?;
    let text = plugin.value("label");
    let label = text.as_deref().and_then(|text| text.trim().parse().ok());
    if label.is_none() {
        let said = text.unwrap_or_default();
        diagnostics.push(
            Diagnostic::warning("bad-label", format!("`{said}` is not a label"))
                .at(plugin.origin)
                .help("write <label> with an integer from 0 to 255"),
        );
    }
    label
}

/// Returns true for `gz-sim-label-system` and its older names.
#[must_use]
pub fn is_label_plugin(plugin: &Plugin) -> bool {
    plugin.filename.contains("label-system") || plugin.name.ends_with("::systems::Label")
}
