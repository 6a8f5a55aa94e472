//! Maps with the tables derived from them, shared by filters.

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak};

use periplus_diagnostics::Diagnostic;
use periplus_grid::OccupancyGrid;

use crate::global_localization::GlobalLocalizer;
use crate::likelihood_map::{LikelihoodMap, LikelihoodMapSettings};
use crate::sensor_model::tables::SensorTables;
use crate::settings::Settings;

/// Maps with the tables derived from them. Filters that share this have each map and its tables once; a map is dropped
/// with the last filter that has it. The results of a filter do not depend on the others.
#[derive(Debug, Default)]
pub struct SharedMaps(Mutex<Vec<Weak<MapTables>>>);

/// Map with its tables.
#[derive(Debug)]
struct MapTables {
    grid: OccupancyGrid,
    settings: LikelihoodMapSettings,
    field: LikelihoodMap,
    sensors: Mutex<Vec<Weak<SensorTables>>>,
    /// Search index, built when it is first needed.
    localizer: OnceLock<GlobalLocalizer>,
}

/// Map of a filter.
#[derive(Clone, Debug)]
pub(crate) struct PreparedMap {
    tables: Arc<MapTables>,
    /// Tables of the sensor model; none before the first scan.
    sensor: Option<Arc<SensorTables>>,
}

impl SharedMaps {
    /// Returns a map with its tables, prepared if no filter has it.
    ///
    /// # Errors
    /// When the map has no cells or no obstacles.
    pub(crate) fn prepare(
        &self,
        grid: &OccupancyGrid,
        settings: LikelihoodMapSettings,
    ) -> Result<PreparedMap, Box<Diagnostic>> {
        let mut maps = lock(&self.0);
        let known = living(&mut maps).find(|it| it.settings == settings && it.grid == *grid);
        let tables = match known {
            Some(tables) => tables,
            None => {
                let tables = Arc::new(MapTables {
                    field: LikelihoodMap::new(grid, settings)?,
                    grid: grid.clone(),
                    settings,
                    sensors: Mutex::default(),
                    localizer: OnceLock::new(),
                });
                maps.push(Arc::downgrade(&tables));
                tables
            }
        };
        Ok(PreparedMap { tables, sensor: None })
    }
}

impl PreparedMap {
    pub(crate) fn grid(&self) -> &OccupancyGrid {
        &self.tables.grid
    }

    pub(crate) fn field(&self) -> &LikelihoodMap {
        &self.tables.field
    }

    /// Returns the search index, built on first use.
    pub(crate) fn localizer(&self) -> (&LikelihoodMap, &GlobalLocalizer) {
        let MapTables { field, localizer, .. } = &*self.tables;
        (field, localizer.get_or_init(|| GlobalLocalizer::new(field)))
    }

    /// Returns the search index if it has been built.
    pub(crate) fn built_localizer(&self) -> Option<&GlobalLocalizer> {
        self.tables.localizer.get()
    }

    /// Returns the tables of the sensor model for a maximum range, other ones when settings change.
    pub(crate) fn sensor(
        &mut self,
        settings: &Settings,
        range_max_m: f64,
    ) -> (&LikelihoodMap, &SensorTables) {
        let Settings { sensor_model, mixture, compat, .. } = settings;
        let is_for = |it: &SensorTables| it.is_for(*sensor_model, mixture, range_max_m, *compat);
        let Self { tables, sensor } = self;
        sensor.take_if(|it| !is_for(it));
        let found = sensor.get_or_insert_with(|| {
            let mut sensors = lock(&tables.sensors);
            let known = living(&mut sensors).find(|it| is_for(it));
            known.unwrap_or_else(|| {
                let field = &tables.field;
                let made = SensorTables::new(field, *sensor_model, mixture, range_max_m, *compat);
                let made = Arc::new(made);
                sensors.push(Arc::downgrade(&made));
                made
            })
        });
        (&tables.field, found)
    }
}

/// Drops what nothing has any more, and returns the rest.
fn living<T>(kept: &mut Vec<Weak<T>>) -> impl Iterator<Item = Arc<T>> {
    kept.retain(|one| one.strong_count() > 0);
    kept.iter().filter_map(Weak::upgrade)
}

/// Locks data that no panic can leave inconsistent.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::{Grid, GridInfo, occupancy};

    use super::*;

    /// A room of 2 m by 2 m with a wall on the left.
    fn room() -> OccupancyGrid {
        let info = GridInfo { resolution_m: 0.1, width: 20, height: 20, origin: Pose2::IDENTITY };
        let mut map = Grid { info, cells: vec![occupancy::FREE; 400] };
        for row in 0..20 {
            map[(0, row)] = occupancy::OCCUPIED;
        }
        map
    }

    #[test]
    fn filters_with_the_same_map_and_settings_have_it_once() {
        let maps = SharedMaps::default();
        let settings = Settings::default();
        let prepare = |grid: &OccupancyGrid, settings: &Settings| {
            maps.prepare(grid, settings.map_settings()).unwrap()
        };
        let (mut one, mut two) = (prepare(&room(), &settings), prepare(&room(), &settings));
        assert!(Arc::ptr_eq(&one.tables, &two.tables));
        assert!(std::ptr::eq(one.sensor(&settings, 5.0).1, two.sensor(&settings, 5.0).1));
        assert!(!std::ptr::eq(one.sensor(&settings, 5.0).1, two.sensor(&settings, 6.0).1));
        one.localizer();
        assert!(two.built_localizer().is_some());
        let mut other = room();
        other[(5, 5)] = occupancy::OCCUPIED;
        assert!(!Arc::ptr_eq(&prepare(&other, &settings).tables, &one.tables));
        let far = Settings { distance_max_m: 1.0, ..settings.clone() };
        assert!(!Arc::ptr_eq(&prepare(&room(), &far).tables, &one.tables));
    }

    #[test]
    fn a_map_is_dropped_with_its_last_filter() {
        let maps = SharedMaps::default();
        let settings = Settings::default().map_settings();
        let kept = maps.prepare(&room(), settings).unwrap();
        assert_eq!(living(&mut lock(&maps.0)).count(), 1);
        drop(kept);
        assert_eq!(living(&mut lock(&maps.0)).count(), 0);
    }
}
