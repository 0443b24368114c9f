/* Contains facts that the analyzers of scripts/static.sh cannot derive, because they read one file at a time. A
 * function that reports a failure returns false, and an array that has grown is not NULL. The script includes this
 * header before each file. ANALYZED_MODEL, ANALYZED_FILES and ANALYZED_SCRIPT select the layers of a file, because
 * several layers use equal names. */
#ifndef VS_SCRIPTS_ANALYZER_H
#define VS_SCRIPTS_ANALYZER_H

#include "bind/call/raise.h"
#include "model/store/array.h"
#undef VS_GROW
#define VS_GROW(array, room, need) \
  (((need) <= (room) || vs_room_grow(&(array), &(room), need, sizeof *(array))) && (array) != NULL)

#if defined(ANALYZED_SCRIPT)
#include "languages/javascript/script.h"
#define vs_script_fail(...) ((void)(vs_script_fail)(__VA_ARGS__), false)
#elif defined(ANALYZED_MODEL)
#define vs_error_set(...) ((void)(vs_error_set)(__VA_ARGS__), false)
#define vs_error_memory(...) ((void)(vs_error_memory)(__VA_ARGS__), false)
#define vs_bind_error(...) ((void)(vs_bind_error)(__VA_ARGS__), VS_ERROR)
#ifdef ANALYZED_FILES
#include "geometry/files/byte_scan.h"
#define vs_scan_fail(...) ((void)(vs_scan_fail)(__VA_ARGS__), false)
#endif
#else
#include "vm/front/expand.h"
#define vs_expand_fail(...) ((void)(vs_expand_fail)(__VA_ARGS__), false)
#endif

#if !defined(ANALYZED_SCRIPT)
#include "vm/machine/native.h"
#define vs_fail(...) ((void)(vs_fail)(__VA_ARGS__), VS_ERROR)
#define vs_fail_type(...) ((void)(vs_fail_type)(__VA_ARGS__), VS_ERROR)
#define vs_fail_range(...) ((void)(vs_fail_range)(__VA_ARGS__), VS_ERROR)
#define vs_fail_with(...) ((void)(vs_fail_with)(__VA_ARGS__), VS_ERROR)
#define vs_fail_at(...) ((void)(vs_fail_at)(__VA_ARGS__), VS_ERROR)
#define vs_fail_memory(...) ((void)(vs_fail_memory)(__VA_ARGS__), VS_ERROR)
#define vs_fail_object(...) ((void)(vs_fail_object)(__VA_ARGS__), VS_ERROR)
#endif

#endif
