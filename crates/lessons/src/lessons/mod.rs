//! All lessons by course: another one is a file of this folder with its text, and a line in the list below.

use crate::course::{Course, Courses};

/// Declares the files of the lessons, and makes the list of their courses.
macro_rules! courses {
    ($($course:literal { $($file:ident,)* })*) => {
        $($(mod $file;)*)*

        const ALL: &[Course] = &[$(Course {
            name: $course,
            text: include_str!(concat!("../../texts/en/courses/", $course, ".md")),
            lessons: &[$(&$file::LESSON),*],
        }),*];
    };
}

courses! {
    "finding-ones-way" {
        why_gps_fails,
        dead_reckoning_drifts,
        wind_carries,
        landmark_corrects,
        how_well_known,
        several_landmarks,
        look_from_above,
    }
    "the-filter" {
        gaussian_by_hand,
        bent_function,
        alpha_beta_kappa,
        cloud_grows,
        camera_chain,
        camera_picture,
        look_corrects_wind,
        joint_update,
        covariance_positive,
        gate_and_nis,
        nees_honest,
        tuning_noise,
        wind_on_turns,
        smoothing,
        late_look,
    }
    "seeing" {
        look_alikes,
        score_surface,
        laying_flat,
        another_date,
        cascade_stages,
        straight_road,
        bag_of_words,
        which_is_which,
    }
    "planning" {
        what_a_corridor_means,
        distinct_landmarks,
        landmark_to_add,
        the_way_round,
        how_often_to_look,
        how_high_to_fly,
    }
    "when-things-go-wrong" {
        compass_off,
        camera_late,
        airspeed_stuck,
        twin_landmark,
        wrong_wind,
        night_and_snow,
    }
}

/// Every course in the order in which they are read.
pub fn all() -> Courses {
    Courses(ALL)
}
