//! Sensors that find objects: sensor heads that pass close over the ground, and cameras.

use crate::geo::maths;
use crate::mission::weather::Light;

/// The type of a detector.
#[derive(Debug, PartialEq)]
pub(crate) enum DetectorSpec {
    /// The sensor detects objects directly below it.
    Ground(Ground),
    Camera(Camera),
}

/// A sensor head that passes close over the ground.
#[derive(Debug, PartialEq)]
pub(crate) struct Ground {
    /// The width of the strip that the sensor covers.
    pub swath_m: f64,
    /// Its detection of mines on one pass.
    pub mines: MineSpec,
}

/// A sensor's probability of finding mines on one pass, and how it falls with height and speed.
///
/// The values are orders of magnitude from humanitarian demining, not measured values of a product.
#[derive(Debug, PartialEq)]
pub(crate) struct MineSpec {
    /// The best probability for metal mines, minimum-metal mines, surface mines, and scrap.
    pub best: [f64; 4],
    /// The height up to which its probability is best.
    pub height_m: f64,
    /// The scale of the decline above it: `exp(-((h - height) / height_scale)^2)`.
    pub height_scale_m: f64,
    /// The speed at which half of the probability is left: `1 / (1 + exp((v - speed) / (0.15 speed)))`.
    pub speed_m_s: f64,
    /// False alarms per square metre covered.
    pub false_alarms_per_m2: f64,
}

/// A camera that looks down, or on a gimbal at an object to inspect.
#[derive(Debug, PartialEq)]
pub(crate) struct Camera {
    pub band: Band,
    /// Field of view across and along the course.
    pub view_deg: [f64; 2],
    /// The width of its picture in pixels.
    pub pixels: f64,
    /// Its mine detection; `None` if it cannot find mines.
    pub mines: Option<MineSpec>,
    /// The greatest distance of an inspection; `None` for cameras that cannot look sideways.
    pub inspects_to_m: Option<f64>,
}

/// The band that a camera sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Band {
    Visible,
    Thermal,
}

impl DetectorSpec {
    /// The maximum distance, east or north, at which it can see an object from a height.
    pub fn reach_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(_) => self.strip_reach_m(height_m),
            Self::Camera(camera) => {
                let aside_m = 2.0 * camera.inspects_to_m.unwrap_or(0.0);
                self.strip_reach_m(height_m).max(aside_m)
            }
        }
    }

    /// Whether it works at a height and a speed: a ground sensor keeps at least half of its best
    /// probability, a camera finds at least half of all people in the open.
    pub fn works(&self, height_m: f64, speed_m_s: f64, light: Light) -> bool {
        match self {
            Self::Ground(ground) => ground.mines.left(height_m, speed_m_s) >= 0.5,
            Self::Camera(camera) => camera.shows_persons(height_m, light),
        }
    }

    /// Whether an offset across and along the course is in its covered strip.
    pub fn covers(&self, [across, along]: [f64; 2], height_m: f64) -> bool {
        // The tolerance, so that adjacent strips leave no gap.
        const TOUCH_M: f64 = 1e-6;
        let [width, length] = match self {
            Self::Ground(ground) => [ground.swath_m; 2],
            Self::Camera(camera) => camera.footprint_m(height_m),
        };
        across.abs() <= width / 2.0 + TOUCH_M && along.abs() <= length / 2.0 + TOUCH_M
    }

    /// The maximum distance of a point that it can cover.
    pub fn strip_reach_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(ground) => ground.swath_m,
            Self::Camera(camera) => {
                let [across, along] = camera.footprint_m(height_m);
                maths::hypot(across, along) / 2.0
            }
        }
    }

    /// The width of the strip that it covers at a height above the ground.
    pub fn swath_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(ground) => ground.swath_m,
            Self::Camera(camera) => camera.footprint_m(height_m)[0],
        }
    }
}

impl Camera {
    /// Its footprint on the ground at a height, across and along the course: `2 h tan(FOV / 2)`.
    pub fn footprint_m(&self, height_m: f64) -> [f64; 2] {
        let side = |angle: f64| 2.0 * height_m.max(0.0) * maths::tan(angle.to_radians() / 2.0);
        self.view_deg.map(side)
    }

    /// Size of a pixel on the ground: `2 h tan(FOV / 2) / px`.
    pub fn pixel_m(&self, height_m: f64) -> f64 {
        self.footprint_m(height_m)[0] / self.pixels
    }
}
