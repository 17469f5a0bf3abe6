//! Sensors that find objects: heads that pass closely over the ground, and cameras.

use crate::geo::maths;
use crate::mission::weather::Light;

/// How a sensor finds things.
#[derive(Debug, PartialEq)]
pub(crate) enum DetectorSpec {
    /// It feels what lies right below it.
    Ground(Ground),
    Camera(Camera),
}

/// A head that passes closely over the ground.
#[derive(Debug, PartialEq)]
pub(crate) struct Ground {
    /// Width of the strip that it covers.
    pub swath_m: f64,
    /// How well it finds mines on one pass.
    pub mines: MineSpec,
}

/// How well a sensor finds mines on one pass at best, and how that wears off with height and speed.
///
/// Orders of magnitude from humanitarian demining, not measurements of a product.
#[derive(Debug, PartialEq)]
pub(crate) struct MineSpec {
    /// Probability for mines of metal, with hardly any metal, lying open, and for scrap.
    pub best: [f64; 4],
    /// Up to this height it works at its best.
    pub height_m: f64,
    /// How fast it gets worse above: `exp(-((h - height) / height_scale)^2)`.
    pub height_scale_m: f64,
    /// Half is left at this speed: `1 / (1 + exp((v - speed) / (0.15 speed)))`.
    pub speed_m_s: f64,
    /// False alarms per square metre that it passes over.
    pub false_alarms_per_m2: f64,
}

/// A camera that looks down, or on a gimbal at what it inspects.
#[derive(Debug, PartialEq)]
pub(crate) struct Camera {
    pub band: Band,
    /// Field of view across and along the course.
    pub view_deg: [f64; 2],
    /// How many pixels its picture is wide.
    pub pixels: f64,
    /// How well it finds mines, for those that do at all.
    pub mines: Option<MineSpec>,
    /// The farthest from which it shows a defect well; `None` for cameras that cannot look to the side.
    pub inspects_to_m: Option<f64>,
}

/// The light that a camera sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Band {
    Visible,
    /// Sees how warm things are.
    Thermal,
}

impl DetectorSpec {
    /// Nothing farther than this to the east or north is seen from a height.
    pub fn reach_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(_) => self.strip_reach_m(height_m),
            Self::Camera(camera) => {
                let aside_m = 2.0 * camera.inspects_to_m.unwrap_or(0.0);
                self.strip_reach_m(height_m).max(aside_m)
            }
        }
    }

    /// Whether it works at a height and a speed: half of its best, or half of all persons, are found.
    pub fn works(&self, height_m: f64, speed_m_s: f64, light: Light) -> bool {
        match self {
            Self::Ground(ground) => ground.mines.left(height_m, speed_m_s) >= 0.5,
            Self::Camera(camera) => camera.shows_persons(height_m, light),
        }
    }

    /// Whether it finds well what lies so far across and along the course.
    pub fn covers(&self, [across, along]: [f64; 2], height_m: f64) -> bool {
        // A strip that just touches the next one leaves no gap between them.
        const TOUCH_M: f64 = 1e-6;
        let [width, length] = match self {
            Self::Ground(ground) => [ground.swath_m; 2],
            Self::Camera(camera) => camera.footprint_m(height_m),
        };
        across.abs() <= width / 2.0 + TOUCH_M && along.abs() <= length / 2.0 + TOUCH_M
    }

    /// How far away anything can be that it covers.
    pub fn strip_reach_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(ground) => ground.swath_m,
            Self::Camera(camera) => {
                let [across, along] = camera.footprint_m(height_m);
                maths::hypot(across, along) / 2.0
            }
        }
    }

    /// How wide a strip it covers on a pass at a height above the ground.
    pub fn swath_m(&self, height_m: f64) -> f64 {
        match self {
            Self::Ground(ground) => ground.swath_m,
            Self::Camera(camera) => camera.footprint_m(height_m)[0],
        }
    }
}

impl Camera {
    /// What it sees of the ground at a height, across and along the course: `2 h tan(FOV / 2)`.
    pub fn footprint_m(&self, height_m: f64) -> [f64; 2] {
        let side = |angle: f64| 2.0 * height_m.max(0.0) * maths::tan(angle.to_radians() / 2.0);
        self.view_deg.map(side)
    }

    /// Size of a pixel on the ground: `2 h tan(FOV / 2) / px`.
    pub fn pixel_m(&self, height_m: f64) -> f64 {
        self.footprint_m(height_m)[0] / self.pixels
    }
}
