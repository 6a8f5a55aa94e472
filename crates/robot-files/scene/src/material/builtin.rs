//! Gazebo's materials `Gazebo/...`, as colours.
//!
//! The values are those of `gazebo.material` (gz-sim, `MaterialParser`, and before it Gazebo Classic). A
//! material with a texture has one colour here, chosen by eye to resemble the texture from a distance.

use super::{Colour, Material};

/// Name, ambient, diffuse, specular, emissive.
type Row = (&'static str, [f64; 4], [f64; 4], [f64; 4], [f64; 3]);

const DARK: [f64; 3] = [0.0; 3];
/// Default specular colour.
const SHEEN: [f64; 3] = [0.1; 3];

const fn opaque([r, g, b]: [f64; 3]) -> [f64; 4] {
    [r, g, b, 1.0]
}

/// Same ambient and diffuse colour.
const fn plain(name: &'static str, rgb: [f64; 3], specular: [f64; 3]) -> Row {
    (name, opaque(rgb), opaque(rgb), opaque(specular), DARK)
}

/// Emissive colour.
const fn glowing(name: &'static str, rgb: [f64; 3], specular: [f64; 3]) -> Row {
    (name, opaque(rgb), opaque(rgb), opaque(specular), rgb)
}

/// Transparent colour.
const fn clear(name: &'static str, [r, g, b]: [f64; 3], alpha: f64) -> Row {
    (name, [r, g, b, alpha], [r, g, b, alpha], opaque(DARK), DARK)
}

/// Texture, by the colour that resembles it.
const fn picture(name: &'static str, rgb: [f64; 3]) -> Row {
    plain(name, rgb, [0.01; 3])
}

const TABLE: &[Row] = &[
    plain("Gazebo/Black", [0.0; 3], SHEEN),
    clear("Gazebo/BlackTransparent", [0.0; 3], 0.5),
    plain("Gazebo/Blue", [0.0, 0.0, 1.0], SHEEN),
    glowing("Gazebo/BlueGlow", [0.0, 0.0, 1.0], SHEEN),
    clear("Gazebo/BlueLaser", [0.0, 0.0, 1.0], 0.4),
    clear("Gazebo/BlueTransparent", [0.0, 0.0, 1.0], 0.5),
    clear("Gazebo/BlueTransparentOverlay", [0.0, 0.0, 1.0], 0.5),
    picture("Gazebo/Bricks", [0.53, 0.33, 0.27]),
    picture("Gazebo/BuildingFrame", [0.6, 0.6, 0.6]),
    picture("Gazebo/CeilingTiled", [0.8, 0.8, 0.78]),
    picture("Gazebo/CloudySky", [0.62, 0.7, 0.8]),
    picture("Gazebo/CoM", [0.5, 0.5, 0.5]),
    plain("Gazebo/DarkGray", [0.175; 3], [0.175; 3]),
    plain("Gazebo/DarkGrey", [0.175; 3], [0.175; 3]),
    clear("Gazebo/DarkMagentaTransparent", [0.6, 0.0, 0.6], 0.5),
    clear("Gazebo/DarkOrangeTransparentOverlay", [0.6, 0.305, 0.028], 0.8),
    plain("Gazebo/DarkYellow", [0.7, 0.7, 0.0], DARK),
    plain("Gazebo/Editor", [1.0; 3], SHEEN),
    plain("Gazebo/FlatBlack", [0.1; 3], [0.01; 3]),
    picture("Gazebo/Footway", [0.6, 0.6, 0.58]),
    picture("Gazebo/Grass", [0.3, 0.42, 0.18]),
    plain("Gazebo/Green", [0.0, 1.0, 0.0], SHEEN),
    glowing("Gazebo/GreenGlow", [0.0, 1.0, 0.0], SHEEN),
    clear("Gazebo/GreenTransparent", [0.0, 1.0, 0.0], 0.5),
    clear("Gazebo/GreenTransparentOverlay", [0.0, 1.0, 0.0], 0.5),
    picture("Gazebo/GreyGradientSky", [0.7, 0.7, 0.7]),
    clear("Gazebo/GreyTransparent", [0.5; 3], 0.5),
    plain("Gazebo/Indigo", [0.33, 0.0, 0.5], SHEEN),
    glowing("Gazebo/JointAnchor", [1.0; 3], [1.0; 3]),
    picture("Gazebo/Lane_1", [0.42, 0.41, 0.4]),
    picture("Gazebo/Lanes_2", [0.4, 0.4, 0.38]),
    picture("Gazebo/Lanes_4", [0.35, 0.35, 0.34]),
    picture("Gazebo/Lanes_6", [0.3, 0.3, 0.3]),
    clear("Gazebo/LightBlueLaser", [0.5, 0.5, 1.0], 0.4),
    glowing("Gazebo/LightOff", [1.0, 0.0, 0.0], DARK),
    glowing("Gazebo/LightOn", [0.0, 1.0, 0.0], DARK),
    picture("Gazebo/Motorway", [0.3, 0.3, 0.3]),
    plain("Gazebo/Orange", [1.0, 0.5088, 0.0468], [0.5; 3]),
    clear("Gazebo/OrangeTransparent", [1.0, 0.44, 0.0], 0.4),
    clear("Gazebo/OrangeTransparentOverlay", [1.0, 0.5088, 0.0468], 0.8),
    picture("Gazebo/PaintedWall", [0.82, 0.8, 0.74]),
    picture("Gazebo/Pedestrian", [0.6, 0.6, 0.58]),
    picture("Gazebo/Primary", [0.4, 0.4, 0.38]),
    plain("Gazebo/Purple", [1.0, 0.0, 1.0], SHEEN),
    glowing("Gazebo/PurpleGlow", [1.0, 0.0, 1.0], SHEEN),
    plain("Gazebo/Red", [1.0, 0.0, 0.0], SHEEN),
    plain("Gazebo/RedBright", [0.87, 0.26, 0.07], [0.87, 0.26, 0.07]),
    glowing("Gazebo/RedGlow", [1.0, 0.0, 0.0], DARK),
    clear("Gazebo/RedTransparent", [1.0, 0.0, 0.0], 0.5),
    clear("Gazebo/RedTransparentOverlay", [1.0, 0.0, 0.0], 0.5),
    picture("Gazebo/Residential", [0.42, 0.41, 0.4]),
    picture("Gazebo/Road", [0.3, 0.3, 0.3]),
    picture("Gazebo/Runway", [0.33, 0.33, 0.33]),
    picture("Gazebo/Secondary", [0.42, 0.41, 0.4]),
    picture("Gazebo/Steps", [0.55, 0.53, 0.5]),
    picture("Gazebo/Tertiary", [0.42, 0.41, 0.4]),
    picture("Gazebo/Trunk", [0.35, 0.35, 0.34]),
    plain("Gazebo/Turquoise", [0.0, 1.0, 1.0], SHEEN),
    glowing("Gazebo/TurquoiseGlow", [0.0, 1.0, 1.0], SHEEN),
    glowing("Gazebo/TurquoiseGlowOutline", [0.0, 1.0, 1.0], SHEEN),
    plain("Gazebo/White", [1.0; 3], SHEEN),
    glowing("Gazebo/WhiteGlow", [1.0; 3], SHEEN),
    picture("Gazebo/Wood", [0.58, 0.42, 0.26]),
    picture("Gazebo/WoodFloor", [0.6, 0.44, 0.28]),
    picture("Gazebo/WoodPallet", [0.62, 0.5, 0.34]),
    plain("Gazebo/Yellow", [1.0, 1.0, 0.0], DARK),
    glowing("Gazebo/YellowGlow", [1.0, 1.0, 0.0], DARK),
    clear("Gazebo/YellowTransparent", [1.0, 1.0, 0.0], 0.5),
    plain("Gazebo/ZincYellow", [0.9725, 0.9529, 0.2078], [0.9725, 0.9529, 0.2078]),
    ("Gazebo/Grey", opaque([0.3; 3]), opaque([0.7; 3]), opaque([0.01; 3]), DARK),
    ("Gazebo/Gray", opaque([0.3; 3]), opaque([0.7; 3]), opaque([0.01; 3]), DARK),
    ("Gazebo/EditorPlane", opaque([0.3; 3]), opaque([0.7; 3]), opaque([0.01; 3]), DARK),
    (
        "Gazebo/Gold",
        opaque([0.4, 0.248_69, 0.020_759]),
        opaque([0.8, 0.648_69, 0.120_759]),
        opaque([0.4; 3]),
        DARK,
    ),
    (
        "Gazebo/Pioneer2Body",
        opaque([0.481_193, 0.000_123, 0.000_123]),
        opaque([0.681_193, 0.000_923, 0.000_923]),
        opaque([0.5; 3]),
        DARK,
    ),
    (
        "Gazebo/PioneerBody",
        opaque([0.5, 0.0, 0.0]),
        opaque([1.0, 0.0, 0.0]),
        opaque([0.5, 0.0, 0.0]),
        DARK,
    ),
    ("Gazebo/SkyBlue", opaque([0.13, 0.44, 0.7]), opaque([0.0, 0.0, 1.0]), opaque(SHEEN), DARK),
];

/// Colours of one of Gazebo's built-in materials, by its full name, such as `Gazebo/Grey`.
#[must_use]
pub fn builtin_material(name: &str) -> Option<Material> {
    // Some files swap the two words.
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

/// Full names of all built-in materials.
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
