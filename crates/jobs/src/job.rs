//! The enum of all orders, made from the list in `lib.rs`.

/// Declares the files of the orders that name theirs, makes the enum of orders, and passes every question about a job on
/// to its order. An order is `Name: pub use file::NameOrder;`, or `Name(NameOrder);` where a module declared elsewhere
/// has several, or where the message holds it in a box.
macro_rules! orders {
    (
        small { $(
            $small:ident $(($small_order:ty))? $(: pub use $small_file:ident::$small_own:ident)?;
        )* }
        whole { $(
            $name:ident $(($order:ty))? $(: pub use $file:ident::$own:ident)?;
        )* }
    ) => {
        $($(mod $small_file;)?)*
        $($(mod $file;)?)*
        $($(pub use $small_file::$small_own;)?)*
        $($(pub use $file::$own;)?)*

        /// Something to do in a worker: one of all orders, as it goes over the wire.
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        pub enum Job {
            $(
                #[doc = concat!("See [`", stringify!($($small_order)? $($small_own)?), "`].")]
                $small($($small_order)? $($small_own)?),
            )*
            $(
                #[doc = concat!("See [`", stringify!($($order)? $($own)?), "`].")]
                $name($($order)? $($own)?),
            )*
        }

        impl Job {
            /// Urgency among the jobs of its worker.
            pub fn urgency(&self) -> Urgency {
                match self {
                    $(Self::$small(_) => <$($small_order)? $($small_own)? as Order>::URGENCY,)*
                    $(Self::$name(_) => <$($order)? $($own)? as Order>::URGENCY,)*
                }
            }

            /// Role of the worker that does it.
            pub fn role(&self) -> WorkerRole {
                match self {
                    $(Self::$small(order) => order.role(),)*
                    $(Self::$name(order) => order.role(),)*
                }
            }

            /// Keys of the provided files that it names.
            pub fn files(&self) -> Vec<&str> {
                match self {
                    $(Self::$small(order) => order.files(),)*
                    $(Self::$name(order) => order.files(),)*
                }
            }

            /// Map of which its worker needs tiles beforehand, and the parts of it.
            pub fn reads(&self) -> Option<(&MapSource, Reads)> {
                match self {
                    $(Self::$small(order) => order.reads(),)*
                    $(Self::$name(order) => order.reads(),)*
                }
            }

            /// Whether the small program does it.
            pub fn is_small(&self) -> bool {
                match self {
                    $(Self::$small(order) => order.is_small(),)*
                    _ => false,
                }
            }

            /// Makes it ready to advance in the small program, which links nothing else; other jobs fail with their
            /// first step.
            pub fn begin_small(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
                match self {
                    $(Self::$small(order) => order.begin(worker),)*
                    _ => running::once(|_, _| {
                        Err("this worker cannot do that; load the page again".to_owned())
                    }),
                }
            }

            /// Makes it ready to advance.
            pub fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
                match self {
                    $(Self::$small(order) => order.begin(worker),)*
                    $(Self::$name(order) => order.begin(worker),)*
                }
            }
        }
    };
}
