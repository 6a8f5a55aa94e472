//! A world of 20 MB, as generated worlds are.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use periplus_loader::{LoadContext, load};
use periplus_resources::{MemoryHost, Resolver};

pub(crate) struct Large {
    pub(crate) megabytes: f64,
    pub(crate) models: usize,
    pub(crate) seconds: f64,
}

/// Loads the world in turns and keeps the fastest.
pub(crate) fn large(turns: usize) -> Large {
    let text = text(20_000_000);
    let megabytes = text.len() as f64 / 1e6;
    let host = MemoryHost::new().with_file("/w/large.sdf", text);
    let mut seconds = f64::INFINITY;
    let mut models = 0;
    for _ in 0..turns {
        let resolver = Resolver::new(&host, &[]);
        let setting = LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder: PathBuf::from("/w"),
            arguments: Vec::new(),
            open_meshes: false,
        };
        let started = Instant::now();
        let loaded = load(Path::new("large.sdf"), &setting);
        seconds = seconds.min(started.elapsed().as_secs_f64());
        let scene = loaded.scene.as_ref();
        models = scene.map_or(0, |scene| scene.worlds.iter().map(|world| world.models.len()).sum());
    }
    Large { megabytes, models, seconds }
}

/// Tables with four legs, a lidar on every tenth, until the text is long enough.
fn text(bytes: usize) -> String {
    let mut out =
        String::from("<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n<world name=\"large\">\n");
    let mut index = 0;
    while out.len() < bytes {
        let (x, y) = (index % 300, index / 300);
        let _ = write!(
            out,
            "  <model name=\"table_{index}\">\n    <pose>{x}.5 {y} 0 0 0 0.{index}</pose>\n    <link name=\"top\">\n      \
             <inertial><mass>8.5</mass><inertia><ixx>0.41</ixx><ixy>0</ixy><ixz>0</ixz><iyy>0.73</iyy><iyz>0</iyz><izz>1.1</izz></inertia></inertial>\n"
        );
        for leg in 0..4 {
            let (dx, dy) =
                (if leg % 2 == 0 { -0.4 } else { 0.4 }, if leg < 2 { -0.3 } else { 0.3 });
            for kind in ["collision", "visual"] {
                let _ = write!(
                    out,
                    "      <{kind} name=\"leg_{leg}_{kind}\">\n        <pose>{dx} {dy} 0.35 0 0 0</pose>\n        \
                     <geometry><cylinder><radius>0.02</radius><length>0.7</length></cylinder></geometry>\n      </{kind}>\n"
                );
            }
        }
        if index % 10 == 0 {
            out.push_str(
                "      <sensor name=\"eye\" type=\"gpu_lidar\">\n        <update_rate>10</update_rate>\n        \
                 <lidar><scan><horizontal><samples>360</samples><min_angle>-3.14</min_angle><max_angle>3.14</max_angle></horizontal></scan>\
                 <range><min>0.1</min><max>10</max></range></lidar>\n      </sensor>\n",
            );
        }
        out.push_str("    </link>\n  </model>\n");
        index += 1;
    }
    out.push_str("</world>\n</sdf>\n");
    out
}
