//! Finding what a URI names: packages, models, Fuel cache, files
