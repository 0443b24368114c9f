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
PollFn = CFUNCTYPE(c_bool, c_void_p)
HostFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, POINTER(Handle), c_size_t, POINTER(Handle))


class Host(Structure):
    _fields_ = [("context", c_void_p), ("output", OutputFn), ("input", c_void_p), ("diagnose", DiagnoseFn),
                ("progress", c_void_p), ("poll", PollFn), ("value", c_void_p), ("read_file", c_void_p),
                ("list_folder", c_void_p)]


class Options(Structure):
    _fields_ = [("size", c_size_t), ("host", Host), ("alloc", c_void_p), ("alloc_context", c_void_p), ("limit_time", c_double),
                ("limit_memory", c_size_t), ("limit_steps", c_uint64), ("limit_output", c_size_t),
                ("limit_worker", c_double), ("limit_triangles", c_size_t), ("cache", c_size_t),
                ("keep_calls", c_bool), ("untrusted", c_bool), ("ends_after_interrupt", c_bool),
                ("library_path", c_char_p), ("command_line", c_void_p), ("command_line_count", c_size_t),
                ("limit_stack", c_size_t)]


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


class Gizmo(Structure):
    _fields_ = [("node", Handle), ("kind", c_int), ("at", c_double * 3), ("size", c_double), ("value_count", c_size_t),
                ("value", c_double * 3), ("low", c_double * 3), ("high", c_double * 3), ("step", c_double),
                ("handle_count", c_size_t), ("handles", c_double * 3 * 3), ("axes", c_double * 3 * 3)]


class ParameterInfo(Structure):
    _fields_ = [("name", c_char_p), ("label", c_char_p), ("group", c_char_p), ("type", c_int), ("value", c_char_p),
                ("default_value", c_char_p), ("has_range", c_bool), ("min", c_double), ("max", c_double),
                ("step", c_double), ("choices", POINTER(c_char_p)), ("choice_count", c_size_t), ("at", Span),
                ("unit", c_char_p), ("has_min", c_bool), ("has_max", c_bool)]


class Summary(Structure):
    _fields_ = [("objects", c_size_t), ("solids", c_size_t), ("surfaces", c_size_t), ("regions", c_size_t),
                ("curves", c_size_t), ("has_bounds", c_bool), ("min", c_double * 3), ("max", c_double * 3),
                ("bounds_at_most", c_bool), ("units", c_char_p), ("advice", c_char_p)]


class Development(Structure):
    _fields_ = [("curve", c_int), ("fixed", c_bool), ("exposure", c_double)]


class OutputOptions(Structure):
    _fields_ = [("size", c_size_t), ("width", c_int), ("height", c_int), ("quality", c_int), ("development", Development),
                ("layers", c_bool), ("view", c_char_p), ("part", c_char_p), ("has_camera", c_bool), ("camera", c_double * 7),
                ("has_sun", c_bool), ("sun", c_double * 2), ("tolerance", c_double), ("segments", c_int), ("least_segments", c_int),
                ("passes", c_uint), ("count", c_bool), ("strict", c_bool), ("change", c_bool), ("up_y", c_bool),
                ("units", c_char_p), ("last", c_bool), ("crop", c_int * 4), ("threads", c_uint), ("look", c_char_p)]


class Statistic(Structure):
    _fields_ = [("key", c_char_p), ("value", c_double), ("unit", c_char_p)]


# The header's structures for these classes: a test compares their sizes with the compiler's.
STRUCTURES = {
    "vs_span": Span, "vs_diagnostic_note": Note, "vs_diagnostic": Diagnostic, "vs_host": Host, "vs_options": Options,
    "vs_mesh_part": Part, "vs_mesh_info": MeshInfo, "vs_hit": Hit, "vs_gizmo": Gizmo,
    "vs_parameter_info": ParameterInfo, "vs_summary": Summary, "vs_development": Development,
    "vs_output_options": OutputOptions, "vs_statistic": Statistic,
}

HitFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, POINTER(Hit))
GizmoFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, POINTER(Gizmo))
MaterialFn = CFUNCTYPE(c_uint64, c_void_p, c_char_p)
WriteFn = CFUNCTYPE(c_bool, c_void_p, c_void_p, c_size_t)

_S, _H, _T = c_void_p, Handle, c_char_p
_FUNCTIONS = {
    "vs_version": (_T, []), "vs_options_init": (None, [POINTER(Options), c_size_t]), "vs_new": (_S, [POINTER(Options)]),
    "vs_free": (None, [_S]), "vs_restart": (c_int, [_S]), "vs_interrupt": (None, [_S]),
    "vs_interrupt_clear": (None, [_S]),
    "vs_eval_file": (c_int, [_S, _T, c_uint]),
    "vs_eval_text": (c_int, [_S, _T, c_uint, _T, c_size_t, c_uint]),
    "vs_eval_value": (c_int, [_S, _T, c_uint, _T, c_size_t, c_uint, POINTER(_H)]),
    "vs_parameter_set": (c_bool, [_S, _T, _T]), "vs_parameter_unset": (None, [_S, _T]),
    "vs_parameter_count": (c_size_t, [_S]), "vs_parameter_get": (c_bool, [_S, c_size_t, POINTER(ParameterInfo)]),
    "vs_parameter_unused": (_T, [_S, c_size_t]),
    "vs_drawing_summary": (c_int, [_S, POINTER(Summary)]), "vs_drawing_clear": (None, [_S]),
    "vs_output_options_init": (None, [POINTER(OutputOptions), c_size_t]),
    "vs_write_drawing": (c_int, [_S, _T, _T, POINTER(OutputOptions)]),
    "vs_write_drawing_to": (c_int, [_S, _T, POINTER(OutputOptions), WriteFn, c_void_p]),
    "vs_statistics": (c_size_t, [_S, POINTER(Statistic), c_size_t]),
    "vs_meshes_begin": (c_int, [_S, POINTER(OutputOptions)]), "vs_mesh_next": (c_bool, [_S, POINTER(MeshInfo)]),
    "vs_meshes_forget": (None, [_S]), "vs_material_handler": (None, [_S, MaterialFn, c_void_p]),
    "vs_handle_retain": (_H, [_S, _H]), "vs_handle_release": (None, [_S, _H]),
    "vs_handle_boolean": (_H, [_S, c_bool]), "vs_handle_number": (_H, [_S, c_double]),
    "vs_handle_integer": (_H, [_S, c_int64]), "vs_handle_symbol": (_H, [_S, _T]),
    "vs_handle_number_text": (_H, [_S, _T]), "vs_handle_text_bytes": (_H, [_S, _T, c_size_t]),
    "vs_handle_is_exact": (c_bool, [_S, _H]), "vs_handle_get_text_bytes": (c_void_p, [_S, _H, POINTER(c_size_t)]),
    "vs_handle_point": (_H, [_S] + [c_double] * 3), "vs_handle_vector": (_H, [_S] + [c_double] * 3),
    "vs_handle_list": (_H, [_S, POINTER(_H), c_size_t]), "vs_handle_kind_of": (c_int, [_S, _H]),
    "vs_handle_get_boolean": (c_bool, [_S, _H]),
    "vs_handle_get_numbers": (c_size_t, [_S, _H, POINTER(c_double), c_size_t]),
    "vs_handle_count": (c_size_t, [_S, _H]),
    "vs_handle_item": (_H, [_S, _H, c_size_t]), "vs_handle_same": (c_bool, [_S, _H, _H]),
    "vs_lookup": (_H, [_S, _T]), "vs_define": (c_bool, [_S, _T, _H]),
    "vs_apply": (c_int, [_S, _H, POINTER(_H), c_size_t, POINTER(_H)]),
    "vs_host_procedure": (_H, [_S, _T, HostFn, c_void_p]), "vs_host_fail": (None, [_S, _T]),
    "vs_scene_controller": (_H, [_S]), "vs_node_root": (_H, [_S]),
    "vs_node_create": (_H, [_S, _T, _T, _H]), "vs_node_find": (_H, [_S, _T]),
    "vs_node_place": (c_int, [_S, _H] + [POINTER(c_double)] * 3),
    "vs_node_set_drawing": (c_int, [_S, _H, _H]), "vs_node_add_child": (c_int, [_S, _H, _H]),
    "vs_node_remove_child": (c_int, [_S, _H, _H]), "vs_node_children": (_H, [_S, _H]),
    "vs_node_parent": (_H, [_S, _H]), "vs_node_name": (_T, [_S, _H]), "vs_node_object": (_H, [_S, _H]),
    "vs_node_begin": (c_int, [_S, _H]), "vs_node_end": (c_int, [_S]), "vs_node_focus": (_H, [_S]),
    "vs_node_eval": (c_int, [_S, _H, _T, POINTER(_H)]),
    "vs_node_matrix": (c_bool, [_S, _H, c_bool, POINTER(c_double)]),
    "vs_property_of": (_H, [_S, _H, _T]), "vs_property_get": (c_int, [_S, _H, _T, POINTER(_H)]),
    "vs_property_put": (c_int, [_S, _H, _T, _H]),
    "vs_property_subscribe": (c_uint64, [_S, _H, HostFn, c_void_p]),
    "vs_property_unsubscribe": (c_int, [_S, _H, c_uint64]),
    "vs_post": (c_bool, [_S, _H, _H]), "vs_update": (c_int, [_S]), "vs_scene_frame": (c_int, [_S, c_double]),
    "vs_action_apply": (c_int, [_S, _T, _H]),
    "vs_pick": (c_int, [_S, POINTER(c_double), POINTER(c_double), HitFn, c_void_p]),
    "vs_gizmos": (c_int, [_S, GizmoFn, c_void_p]),
    "vs_input": (c_int, [_S, c_int, c_int, POINTER(c_double), POINTER(c_double), _T, POINTER(_H)]),
}

# The functions of the header without a counterpart in the package, and the reason: a test compares this list and the
# list above with the header.
LEFT_OUT = {
    "a prompt, an editor or a debugger calls these, and Python has its own": (
        "vs_exit_requested vs_read_check vs_complete vs_name_get vs_name_advice vs_place_advice vs_disassemble vs_stop_get "
        "vs_stop_depth vs_resume vs_stop_drop vs_call_get vs_profile vs_profile_get "
        "vs_profile_call vs_coverage vs_coverage_get vs_language_of"),
    "a Python object is kept in a table of the host's, under a number that the program has": (
        "vs_handle_host vs_handle_get_host"),
    "their likes with a length take zero bytes, too": "vs_handle_text vs_handle_get_text",
    "a number's text has integers of any size": "vs_handle_get_integer",
    "an error or the manual lists the formats and passes": (
        "vs_format_list vs_format_endings vs_format_find vs_format_of vs_pass_list vs_look_list vs_unit_name "
        "vs_output_statistics vs_view_name vs_part_names"),
    "the command vs does this with files, and no value of the program takes part": (
        "vs_drawing_keep vs_drawing_compare vs_check_waits vs_check_next vs_check_redefined vs_fit_options_init vs_fit vs_fit_parameter_get vs_fit_distances "
        "vs_fit_map vs_picture_tone vs_picture_false_color vs_picture_illuminance vs_picture_pick vs_picture_compare vs_picture_denoise vs_picture_join vs_picture_tile_top vs_report_get vs_rule_get vs_drawing_face "
        "vs_sun_study vs_is_input vs_input_name vs_note_input"),
    "meshes() hands over what a format of Python's would write": (
        "vs_register_format vs_output_write vs_output_print vs_output_number vs_output_fail vs_thing_numbers "
        "vs_thing_text vs_thing_triangles"),
}


def load():
    """The library, its functions typed. OSError: it is not there, or is of another version."""
    said = os.environ.get("VISUALSCHEME_LIBRARY")
    place = said or ctypes.util.find_library("visualscheme") or "libvisualscheme.so.0"
    try:
        library = ctypes.CDLL(place)
    except OSError as error:
        raise OSError("VisualScheme's library was not found (%s): %s" % (
            error, "VISUALSCHEME_LIBRARY names it" if said else
            "install VisualScheme, or let VISUALSCHEME_LIBRARY be the path of libvisualscheme.so")) from None
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(library, name, None)
        if function is None:
            raise OSError("%s is of another version of VisualScheme than this package: it has no %s" % (place, name))
        function.restype, function.argtypes = result, arguments
    return library
