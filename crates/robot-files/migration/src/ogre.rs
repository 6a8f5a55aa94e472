//! Material scripts of OGRE, as far as colours and the first texture.
//!
//! Source: the OGRE manual, "Material Scripts".

/// Maximum number of words of a script that is read: a limit on work for a file of the wrong kind.
const MAX_WORDS: usize = 1_000_000;

/// Colours and texture of a material.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct OgreMaterial {
    pub(crate) ambient: Option<String>,
    pub(crate) diffuse: Option<String>,
    pub(crate) specular: Option<String>,
    pub(crate) emissive: Option<String>,
    /// File name of the first texture.
    pub(crate) texture: Option<String>,
}

/// Finds a material in a script. The first pass of the first technique decides.
pub(crate) fn find_material(script: &str, name: &str) -> Option<OgreMaterial> {
    let mut material = None;
    let mut depth = 0_usize;
    for line in script.lines() {
        let line = line.split("//").next().unwrap_or_default().trim();
        // A brace may follow on the same line.
        let words: Vec<&str> = line.split_whitespace().take(MAX_WORDS).collect();
        if depth == 0 && words.first() == Some(&"material") {
            if material.is_some() {
                break;
            }
            let found = words.get(1).map(|word| word.trim_matches(['"', ':', '{']));
            if found == Some(name) {
                material = Some(OgreMaterial::default());
            }
        }
        if let (Some(material), true) = (&mut material, depth > 0) {
            read_line(&words, material);
        }
        depth += line.matches('{').count();
        let closed = line.matches('}').count();
        if closed > 0 {
            depth = depth.saturating_sub(closed);
            if depth == 0 && material.is_some() {
                break;
            }
        }
    }
    material
}

fn read_line(words: &[&str], material: &mut OgreMaterial) {
    let Some((first, rest)) = words.split_first() else { return };
    let slot = match *first {
        "ambient" => &mut material.ambient,
        "diffuse" => &mut material.diffuse,
        "specular" => &mut material.specular,
        "emissive" => &mut material.emissive,
        "texture" => {
            if material.texture.is_none() {
                material.texture = rest.first().map(|name| name.trim_matches('"').to_owned());
            }
            return;
        }
        _ => return,
    };
    if slot.is_none() {
        *slot = colour(*first == "specular", rest);
    }
}

/// Red, green, blue, alpha. The last number of a specular colour is its shininess.
fn colour(is_specular: bool, words: &[&str]) -> Option<String> {
    let numbers: Vec<f64> = words.iter().map_while(|word| word.parse().ok()).collect();
    let count = if is_specular { numbers.len().saturating_sub(1) } else { numbers.len() };
    let [r, g, b] = *numbers.first_chunk::<3>()?;
    let a = numbers.get(3).filter(|_| count > 3).copied().unwrap_or(1.0);
    Some(format!("{r} {g} {b} {a}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRIPT: &str = "// Colours
        material Other { technique { pass { diffuse 0 0 0 } } }
        material Wall/Brick
        {
          technique
          {
            pass
            {
              ambient 0.5 0.5 0.5
              diffuse 1 1 1 0.5
              specular 0.2 0.2 0.2 1 12.5
              texture_unit { }
              texture_unit
              {
                texture brick.png
              }
            }
          }
        }
        material Last { technique { pass { ambient 0 0 0 } } }";

    #[test]
    fn a_material_has_its_own_colours_and_texture() {
        let material = find_material(SCRIPT, "Wall/Brick").unwrap();
        assert_eq!(material.ambient.as_deref(), Some("0.5 0.5 0.5 1"));
        assert_eq!(material.diffuse.as_deref(), Some("1 1 1 0.5"));
        assert_eq!(material.specular.as_deref(), Some("0.2 0.2 0.2 1"));
        assert_eq!(material.emissive, None);
        assert_eq!(material.texture.as_deref(), Some("brick.png"));
        assert_eq!(find_material(SCRIPT, "Missing"), None);
    }
}
