//! The materials that Gazebo brings along under `Gazebo/...`, as colours.
//!
//! Numbers after the names in Gazebo Classic's `gazebo.material`; those with a texture there get
//! the mean colour that the texture is known for.

use super::{Colour, Material};

/// Name, ambient, diffuse, specular, emissive.
type Row = (&'static str, [f64; 4], [f64; 4], [f64; 4], [f64; 3]);

const NONE: [f64; 3] = [0.0; 3];
const DULL: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
const FAINT: [f64; 4] = [0.01, 0.01, 0.01, 1.0];
const SHINY: [f64; 4] = [0.1, 0.1, 0.1, 1.0];

/// The same colour in the shade and in the light.
const fn plain(name: &'static str, rgb: [f64; 3], specular: [f64; 4]) -> Row {
    let [r, g, b] = rgb;
    (name, [r, g, b, 1.0], [r, g, b, 1.0], specular, NONE)
}

/// A colour that shines by itself.
const fn glowing(name: &'static str, rgb: [f64; 3]) -> Row {
    let [r, g, b] = rgb;
    (name, [r, g, b, 1.0], [r, g, b, 1.0], DULL, rgb)
}

const fn clear(name: &'static str, rgb: [f64; 3], alpha: f64) -> Row {
    let [r, g, b] = rgb;
    (name, [r, g, b, alpha], [r, g, b, alpha], DULL, NONE)
}

const TABLE: &[Row] = &[
    plain("Gazebo/Black", [0.0, 0.0, 0.0], SHINY),
    clear("Gazebo/BlackTransparent", [0.0, 0.0, 0.0], 0.5),
    plain("Gazebo/Blue", [0.0, 0.0, 1.0], SHINY),
    plain("Gazebo/BlueLaser", [0.0, 0.0, 1.0], DULL),
    glowing("Gazebo/BlueGlow", [0.0, 0.0, 1.0]),
    clear("Gazebo/BlueTransparent", [0.0, 0.0, 1.0], 0.5),
    glowing("Gazebo/BlueTransparentOverlay", [0.0, 0.0, 1.0]),
    plain("Gazebo/Bricks", [0.53, 0.33, 0.27], DULL),
    plain("Gazebo/CardboardBox", [0.62, 0.48, 0.33], DULL),
    plain("Gazebo/CeilingTiled", [0.8, 0.8, 0.78], DULL),
    plain("Gazebo/CloudySky", [0.62, 0.7, 0.8], DULL),
    plain("Gazebo/DarkGray", [0.175, 0.175, 0.175], SHINY),
    plain("Gazebo/DarkGrey", [0.175, 0.175, 0.175], SHINY),
    plain("Gazebo/DarkMagentaTransparent", [0.6, 0.0, 0.6], DULL),
    plain("Gazebo/DarkOrangeTransparent", [1.0, 0.55, 0.0], DULL),
    plain("Gazebo/DarkYellow", [0.7, 0.7, 0.0], DULL),
    plain("Gazebo/FlatBlack", [0.1, 0.1, 0.1], FAINT),
    plain("Gazebo/Fish", [0.75, 0.45, 0.2], DULL),
    plain("Gazebo/Gold", [0.8, 0.648_48, 0.120_04], SHINY),
    plain("Gazebo/Grass", [0.3, 0.42, 0.18], DULL),
    plain("Gazebo/Gray", [0.7, 0.7, 0.7], SHINY),
    plain("Gazebo/Green", [0.0, 1.0, 0.0], SHINY),
    glowing("Gazebo/GreenGlow", [0.0, 1.0, 0.0]),
    clear("Gazebo/GreenTransparent", [0.0, 1.0, 0.0], 0.5),
    plain("Gazebo/Grey", [0.7, 0.7, 0.7], FAINT),
    clear("Gazebo/GreyGradientSky", [0.7, 0.7, 0.7], 1.0),
    clear("Gazebo/GreyTransparent", [0.5, 0.5, 0.5], 0.5),
    plain("Gazebo/Indigo", [0.33, 0.0, 0.5], SHINY),
    plain("Gazebo/LightBlueLaser", [0.5, 0.5, 1.0], DULL),
    plain("Gazebo/LightOn", [0.0, 1.0, 0.0], DULL),
    plain("Gazebo/LightOff", [1.0, 0.0, 0.0], DULL),
    plain("Gazebo/Motorway", [0.3, 0.3, 0.3], DULL),
    clear("Gazebo/OrangeTransparent", [1.0, 0.44, 0.0], 0.6),
    glowing("Gazebo/OrangeTransparentOverlay", [1.0, 0.44, 0.0]),
    plain("Gazebo/Orange", [1.0, 0.5088, 0.0468], [0.5, 0.5, 0.5, 1.0]),
    plain("Gazebo/PaintedWall", [0.82, 0.8, 0.74], DULL),
    plain("Gazebo/Pedestrian", [0.6, 0.6, 0.58], DULL),
    plain("Gazebo/PioneerBody", [0.5, 0.0, 0.0], DULL),
    plain("Gazebo/Primary", [0.6, 0.6, 0.55], DULL),
    plain("Gazebo/Purple", [1.0, 0.0, 1.0], SHINY),
    glowing("Gazebo/PurpleGlow", [1.0, 0.0, 1.0]),
    plain("Gazebo/Red", [1.0, 0.0, 0.0], SHINY),
    plain("Gazebo/RedBright", [0.87, 0.26, 0.07], SHINY),
    glowing("Gazebo/RedGlow", [1.0, 0.0, 0.0]),
    clear("Gazebo/RedTransparent", [1.0, 0.0, 0.0], 0.5),
    glowing("Gazebo/RedTransparentOverlay", [1.0, 0.0, 0.0]),
    plain("Gazebo/Residential", [0.42, 0.41, 0.4], DULL),
    plain("Gazebo/Road", [0.3, 0.3, 0.3], DULL),
    plain("Gazebo/SkyBlue", [0.13, 0.44, 0.7], SHINY),
    plain("Gazebo/Shell", [0.8, 0.7, 0.6], DULL),
    plain("Gazebo/Turquoise", [0.0, 1.0, 1.0], SHINY),
    glowing("Gazebo/TurquoiseGlow", [0.0, 1.0, 1.0]),
    clear("Gazebo/TurquoiseGlowOutline", [0.0, 1.0, 1.0], 1.0),
    plain("Gazebo/White", [1.0, 1.0, 1.0], SHINY),
    glowing("Gazebo/WhiteGlow", [1.0, 1.0, 1.0]),
    plain("Gazebo/Wood", [0.58, 0.42, 0.26], DULL),
    plain("Gazebo/WoodFloor", [0.6, 0.44, 0.28], DULL),
    plain("Gazebo/WoodPallet", [0.62, 0.5, 0.34], DULL),
    plain("Gazebo/Yellow", [1.0, 1.0, 0.0], SHINY),
    glowing("Gazebo/YellowGlow", [1.0, 1.0, 0.0]),
    clear("Gazebo/YellowTransparent", [1.0, 1.0, 0.0], 0.5),
    glowing("Gazebo/YellowTransparentOverlay", [1.0, 1.0, 0.0]),
    plain("Gazebo/ZincYellow", [0.9725, 0.9529, 0.2078], SHINY),
];

/// The colours of one of Gazebo's built-in materials, by its full name, such as `Gazebo/Grey`.
#[must_use]
pub fn builtin_material(name: &str) -> Option<Material> {
    // Some files turn the two words around.
    let turned =
        name.strip_prefix("Gazebo/Transparent").map(|colour| format!("Gazebo/{colour}Transparent"));
    let row = TABLE.iter().find(|row| row.0 == name || Some(row.0) == turned.as_deref())?;
    let (_, ambient, diffuse, specular, [r, g, b]) = *row;
    Some(Material {
        ambient: Some(Colour(ambient)),
        diffuse: Some(Colour(diffuse)),
        specular: Some(Colour(specular)),
        emissive: Some(Colour([r, g, b, 1.0])),
        ..Material::default()
    })
}

/// The full names of all built-in materials.
pub fn builtin_material_names() -> impl Iterator<Item = &'static str> + Clone {
    TABLE.iter().map(|row| row.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_their_names() {
        let diffuse = |name| builtin_material(name).and_then(|material| material.diffuse);
        assert_eq!(diffuse("Gazebo/Red"), Some(Colour([1.0, 0.0, 0.0, 1.0])));
        assert_eq!(diffuse("Gazebo/TransparentGreen"), Some(Colour([0.0, 1.0, 0.0, 0.5])));
        assert_eq!(diffuse("Gazebo/Pink"), None);
        assert_eq!(diffuse("Red"), None);
    }

    #[test]
    fn names_are_unique() {
        let names: std::collections::BTreeSet<_> = builtin_material_names().collect();
        assert_eq!(names.len(), TABLE.len());
    }
}
