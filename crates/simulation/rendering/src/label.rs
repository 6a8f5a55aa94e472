//! Labels for segmentation.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Plugin;

/// The label that the plugins of a visual or model give (gz-sim's `Label` system), 0 to 255.
pub(crate) fn label_of(plugins: &[Plugin], diagnostics: &mut Diagnostics) -> Option<u8> {
    let plugin = plugins.iter().find(|plugin| is_label(plugin))?;
    let text = plugin.value("label");
    let label = text.as_deref().and_then(|text| text.trim().parse().ok());
    if label.is_none() {
        let said = text.unwrap_or_default();
        diagnostics.push(
            Diagnostic::warning("bad-label", format!("`{said}` is no label"))
                .at(plugin.origin)
                .help("write <label> with a whole number from 0 to 255"),
        );
    }
    label
}

/// `gz-sim-label-system`, and the older spellings of the same.
fn is_label(plugin: &Plugin) -> bool {
    plugin.filename.contains("label-system") || plugin.name.ends_with("::systems::Label")
}
