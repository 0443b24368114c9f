"""Owns what of visualscheme.h Python calls: its structures and functions, for ctypes."""
import ctypes
import ctypes.util
import os
from ctypes import (CFUNCTYPE, POINTER, Structure, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint, c_uint32,
                    c_uint64, c_int64, c_void_p)

Handle = c_uint64


class Span(Structure):
    _fields_ = [("file", c_char_p), ("line", c_uint32), ("column", c_uint32), ("end_line", c_uint32),
                ("end_column", c_uint32)]


class Note(Structure):
    _fields_ = [("at", Span), ("message", c_char_p)]


class Diagnostic(Structure):
    _fields_ = [("severity", c_int), ("outcome", c_int), ("at", Span), ("message", c_char_p),
                ("source_line", c_char_p), ("notes", POINTER(Note)), ("note_count", c_size_t)]


OutputFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, c_size_t)
DiagnoseFn = CFUNCTYPE(None, c_void_p, POINTER(Diagnostic))
HostFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, POINTER(Handle), c_size_t, POINTER(Handle))


class Host(Structure):
    _fields_ = [("context", c_void_p), ("output", OutputFn), ("input", c_void_p), ("diagnose", DiagnoseFn),
                ("progress", c_void_p), ("poll", c_void_p), ("value", c_void_p), ("read_file", c_void_p),
                ("list_folder", c_void_p)]


class Options(Structure):
    _fields_ = [("host", Host), ("alloc", c_void_p), ("alloc_context", c_void_p), ("limit_time", c_double),
                ("limit_memory", c_size_t), ("limit_steps", c_uint64), ("limit_output", c_size_t),
                ("limit_worker", c_double), ("limit_triangles", c_size_t), ("cache", c_size_t),
                ("keep_frames", c_bool), ("untrusted", c_bool), ("library_path", c_char_p),
                ("command_line", c_void_p), ("command_line_count", c_size_t)]


class Part(Structure):
    _fields_ = [("material", c_char_p), ("material_id", c_uint64), ("painted", c_bool), ("color", c_double * 4),
                ("roughness", c_double), ("metallic", c_double), ("ior", c_double), ("layer", c_char_p),
                ("file", c_char_p), ("line", c_uint32), ("column", c_uint32)]


class MeshInfo(Structure):
    _fields_ = [("change", c_int), ("id", c_uint64), ("points", POINTER(c_double)), ("point_count", c_size_t),
                ("corners", POINTER(c_uint32)), ("triangle_count", c_size_t), ("normals", POINTER(c_double)),
                ("normal_count", c_size_t), ("normal_corners", POINTER(c_uint32)), ("part_of", POINTER(c_uint32)),
                ("parts", POINTER(Part)), ("part_count", c_size_t), ("places", POINTER(c_double)),
                ("place_count", c_size_t)]


class Hit(Structure):
    _fields_ = [("distance", c_double), ("point", c_double * 3), ("node", Handle), ("path", Handle),
                ("file", c_char_p), ("line", c_uint32), ("column", c_uint32)]


HitFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, POINTER(Hit))

_S, _H, _T = c_void_p, Handle, c_char_p
_FUNCTIONS = {
    "vs_version": (_T, []), "vs_options_default": (Options, []), "vs_new": (_S, [POINTER(Options)]),
    "vs_free": (None, [_S]), "vs_restart": (c_int, [_S]), "vs_interrupt": (None, [_S]),
    "vs_eval_file": (c_int, [_S, _T, c_uint]),
    "vs_eval_text": (c_int, [_S, _T, c_uint, _T, c_size_t, c_uint]),
    "vs_parameter_set": (c_bool, [_S, _T, _T]), "vs_drawing_clear": (None, [_S]),
    "vs_write_drawing": (c_int, [_S, _T, _T, c_void_p]),
    "vs_meshes_begin": (c_int, [_S, c_void_p]), "vs_mesh_next": (c_bool, [_S, POINTER(MeshInfo)]),
    "vs_meshes_forget": (None, [_S]),
    "vs_handle_retain": (_H, [_S, _H]), "vs_handle_release": (None, [_S, _H]),
    "vs_handle_boolean": (_H, [_S, c_bool]), "vs_handle_number": (_H, [_S, c_double]),
    "vs_handle_integer": (_H, [_S, c_int64]), "vs_handle_text": (_H, [_S, _T]), "vs_handle_symbol": (_H, [_S, _T]),
    "vs_handle_point": (_H, [_S] + [c_double] * 3), "vs_handle_vector": (_H, [_S] + [c_double] * 3),
    "vs_handle_list": (_H, [_S, POINTER(_H), c_size_t]), "vs_handle_kind_of": (c_int, [_S, _H]),
    "vs_handle_get_boolean": (c_bool, [_S, _H]),
    "vs_handle_get_numbers": (c_size_t, [_S, _H, POINTER(c_double), c_size_t]),
    "vs_handle_get_text": (_T, [_S, _H]), "vs_handle_count": (c_size_t, [_S, _H]),
    "vs_handle_item": (_H, [_S, _H, c_size_t]), "vs_handle_same": (c_bool, [_S, _H, _H]),
    "vs_lookup": (_H, [_S, _T]), "vs_define": (c_bool, [_S, _T, _H]),
    "vs_apply": (c_int, [_S, _H, POINTER(_H), c_size_t, POINTER(_H)]),
    "vs_host_procedure": (_H, [_S, _T, HostFn, c_void_p]), "vs_host_fail": (None, [_S, _T]),
    "vs_node_root": (_H, [_S]), "vs_node_create": (_H, [_S, _T, _T, _H]), "vs_node_find": (_H, [_S, _T]),
    "vs_node_place": (c_int, [_S, _H] + [POINTER(c_double)] * 3),
    "vs_node_set_drawing": (c_int, [_S, _H, _H]), "vs_node_add_child": (c_int, [_S, _H, _H]),
    "vs_node_remove_child": (c_int, [_S, _H, _H]), "vs_node_children": (_H, [_S, _H]),
    "vs_node_matrix": (c_bool, [_S, _H, c_bool, POINTER(c_double)]),
    "vs_property_of": (_H, [_S, _H, _T]), "vs_property_get": (c_int, [_S, _H, _T, POINTER(_H)]),
    "vs_property_put": (c_int, [_S, _H, _T, _H]),
    "vs_property_subscribe": (c_uint64, [_S, _H, HostFn, c_void_p]),
    "vs_property_unsubscribe": (c_int, [_S, _H, c_uint64]),
    "vs_post": (c_bool, [_S, _H, _H]), "vs_update": (c_int, [_S]), "vs_scene_frame": (c_int, [_S, c_double]),
    "vs_pick": (c_int, [_S, POINTER(c_double), POINTER(c_double), HitFn, c_void_p]),
}


def load():
    """The library, its functions typed."""
    place = os.environ.get("VISUALSCHEME_LIBRARY") or ctypes.util.find_library("visualscheme") or "libvisualscheme.so.0"
    library = ctypes.CDLL(place)
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library
