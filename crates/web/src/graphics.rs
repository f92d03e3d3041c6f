//! Meshes kept on the graphics card: sent once, drawn in every frame from there.
//!
//! egui's painter calls back in the middle of its own work and sets all of its state anew afterwards;
//! blending and clipping are those it has set before.

use std::any::Any;
use std::cell::RefCell;
use std::sync::{Arc, Weak};

use eframe::egui_glow::CallbackFn;
use egui::epaint::Mesh;
use js_sys::{Uint8Array, Uint32Array};
use pilotage_ui::kept_mesh::{MeshKeeper, PlacedMesh};
use pilotage_ui::short_map::ShortMap;
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::{
    HtmlCanvasElement, WebGl2RenderingContext as Gl, WebGlBuffer, WebGlProgram, WebGlShader,
    WebGlUniformLocation, WebGlVertexArrayObject,
};

const VERTEX_SHADER: &str = "#version 300 es
uniform vec2 screen;
uniform vec4 place;
uniform float strength;
in vec2 position;
in vec4 color;
out vec4 shade;
void main() {
    vec2 point = place.xy + vec2(
        place.z * position.x + place.w * position.y,
        place.z * position.y - place.w * position.x);
    gl_Position = vec4(2.0 * point.x / screen.x - 1.0, 1.0 - 2.0 * point.y / screen.y, 0.0, 1.0);
    shade = color * strength;
}";

const FRAGMENT_SHADER: &str = "#version 300 es
precision mediump float;
in vec4 shade;
out vec4 color;
void main() { color = shade; }";

/// Bytes of a corner: two coordinates and a colour.
const STRIDE: i32 = 12;

thread_local! {
    /// There is one canvas, and the page has one thread.
    static CARD: RefCell<Option<Card>> = const { RefCell::new(None) };
}

/// Keeps meshes in the memory of the graphics card behind the page's canvas.
pub struct Graphics;

impl Graphics {
    /// Makes the context of `canvas` as the page needs it; whoever asks for one later gets this one.
    ///
    /// Meshes bring their own soft edges, and nothing hides behind something else: four samples per pixel
    /// and a depth buffer would be memory for nothing, and most of the time of a page without a graphics
    /// card.
    pub fn prepare(canvas: &HtmlCanvasElement) -> Result<(), JsValue> {
        let options = js_sys::Object::new();
        for name in ["antialias", "depth", "stencil"] {
            js_sys::Reflect::set(&options, &name.into(), &JsValue::FALSE)?;
        }
        canvas.get_context_with_context_options("webgl2", &options)?;
        Ok(())
    }

    /// The keeper for `canvas`, if its graphics card takes the programs.
    pub fn of(canvas: &HtmlCanvasElement) -> Option<Arc<dyn MeshKeeper>> {
        let gl = canvas.get_context("webgl2").ok()??.dyn_into().ok()?;
        let card = Card::new(gl)?;
        CARD.with(|own| *own.borrow_mut() = Some(card));
        Some(Arc::new(Self))
    }
}

impl MeshKeeper for Graphics {
    fn callback(&self, placed: PlacedMesh) -> Arc<dyn Any + Send + Sync> {
        Arc::new(CallbackFn::new(move |info, _| {
            let scale = info.pixels_per_point;
            let screen = info.screen_size_px.map(|side| side as f32 / scale);
            CARD.with(|card| {
                if let Some(card) = &mut *card.borrow_mut() {
                    // What the card cannot hold is not drawn; the page's own drawing goes on.
                    let _ = card.draw(&placed, screen);
                }
            });
        }))
    }
}

struct Card {
    gl: Gl,
    program: WebGlProgram,
    screen: Option<WebGlUniformLocation>,
    place: Option<WebGlUniformLocation>,
    strength: Option<WebGlUniformLocation>,
    kept: ShortMap<usize, MeshOnCard>,
}

/// A mesh on the card, and the one it is the copy of.
struct MeshOnCard {
    origin: Weak<Mesh>,
    arrangement: WebGlVertexArrayObject,
    buffers: [WebGlBuffer; 2],
}

impl Card {
    fn new(gl: Gl) -> Option<Self> {
        let program = gl.create_program()?;
        for (kind, text) in [
            (Gl::VERTEX_SHADER, VERTEX_SHADER),
            (Gl::FRAGMENT_SHADER, FRAGMENT_SHADER),
        ] {
            gl.attach_shader(&program, &shader(&gl, kind, text)?);
        }
        gl.bind_attrib_location(&program, 0, "position");
        gl.bind_attrib_location(&program, 1, "color");
        gl.link_program(&program);
        gl.get_program_parameter(&program, Gl::LINK_STATUS)
            .as_bool()
            .filter(|linked| *linked)?;
        let uniform = |name| gl.get_uniform_location(&program, name);
        Some(Self {
            screen: uniform("screen"),
            place: uniform("place"),
            strength: uniform("strength"),
            program,
            gl,
            kept: ShortMap::default(),
        })
    }

    fn draw(&mut self, placed: &PlacedMesh, screen: [f32; 2]) -> Option<()> {
        let key = Arc::as_ptr(&placed.mesh) as usize;
        // A key is not used again as long as its entry's weak reference holds the place.
        if !self.kept.contains_key(&key) {
            self.forget_the_dropped();
            let kept = self.send(&placed.mesh)?;
            self.kept.insert(key, kept);
        }
        let kept = self.kept.get(&key)?;
        let gl = &self.gl;
        gl.use_program(Some(&self.program));
        gl.bind_vertex_array(Some(&kept.arrangement));
        let (sin, cos) = placed.turned.sin_cos();
        gl.uniform2f(self.screen.as_ref(), screen[0], screen[1]);
        gl.uniform4f(
            self.place.as_ref(),
            placed.origin.x,
            placed.origin.y,
            cos,
            sin,
        );
        for part in &placed.parts {
            gl.uniform1f(self.strength.as_ref(), part.strength);
            gl.draw_elements_with_i32(
                Gl::TRIANGLES,
                part.indices.len() as i32,
                Gl::UNSIGNED_INT,
                4 * part.indices.start as i32,
            );
        }
        gl.bind_vertex_array(None);
        Some(())
    }

    fn send(&self, mesh: &Arc<Mesh>) -> Option<MeshOnCard> {
        let gl = &self.gl;
        let arrangement = gl.create_vertex_array()?;
        let buffers = [gl.create_buffer()?, gl.create_buffer()?];
        let mut corners = Vec::with_capacity(mesh.vertices.len() * STRIDE as usize);
        for vertex in &mesh.vertices {
            corners.extend(vertex.pos.x.to_le_bytes());
            corners.extend(vertex.pos.y.to_le_bytes());
            corners.extend(vertex.color.to_array());
        }
        gl.bind_vertex_array(Some(&arrangement));
        gl.bind_buffer(Gl::ARRAY_BUFFER, Some(&buffers[0]));
        gl.buffer_data_with_array_buffer_view(
            Gl::ARRAY_BUFFER,
            &Uint8Array::from(corners.as_slice()),
            Gl::STATIC_DRAW,
        );
        gl.enable_vertex_attrib_array(0);
        gl.vertex_attrib_pointer_with_i32(0, 2, Gl::FLOAT, false, STRIDE, 0);
        gl.enable_vertex_attrib_array(1);
        gl.vertex_attrib_pointer_with_i32(1, 4, Gl::UNSIGNED_BYTE, true, STRIDE, 8);
        gl.bind_buffer(Gl::ELEMENT_ARRAY_BUFFER, Some(&buffers[1]));
        gl.buffer_data_with_array_buffer_view(
            Gl::ELEMENT_ARRAY_BUFFER,
            &Uint32Array::from(mesh.indices.as_slice()),
            Gl::STATIC_DRAW,
        );
        Some(MeshOnCard {
            origin: Arc::downgrade(mesh),
            arrangement,
            buffers,
        })
    }

    fn forget_the_dropped(&mut self) {
        let gl = &self.gl;
        self.kept.retain(|kept| {
            let in_use = kept.origin.strong_count() > 0;
            if !in_use {
                gl.delete_vertex_array(Some(&kept.arrangement));
                for buffer in &kept.buffers {
                    gl.delete_buffer(Some(buffer));
                }
            }
            in_use
        });
    }
}

fn shader(gl: &Gl, kind: u32, text: &str) -> Option<WebGlShader> {
    let shader = gl.create_shader(kind)?;
    gl.shader_source(&shader, text);
    gl.compile_shader(&shader);
    let compiled = gl.get_shader_parameter(&shader, Gl::COMPILE_STATUS);
    compiled.as_bool().unwrap_or_default().then_some(shader)
}
