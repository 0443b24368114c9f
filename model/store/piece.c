/* Allocates small objects of a store (pieces), mostly nodes. Pieces are cut from large blocks (slabs); freed pieces are
 * kept in a list for each size.
 *
 * A drawing of a million primitives is a million pieces. Therefore a piece must cost few instructions, and has no
 * header. New slabs are larger when there are more pieces, up to SLAB_MOST. All slabs except one are freed when no
 * piece is in use. With a sanitizer and in the stress build each piece is a separate allocation, so that a use after
 * free is detected and each allocation can be made to fail. */
#include "model/store/piece.h"

#include "model/store/store_inside.h"

#include "model/store/piece.h"
#include "model/assert.h"

#include <string.h>

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define PIECES_APART 1
#endif
#endif
#if defined __SANITIZE_ADDRESS__ || (defined VS_DEBUG_STRESS && VS_DEBUG_STRESS)
#define PIECES_APART 1
#endif
#ifndef PIECES_APART
#define PIECES_APART 0
#endif

enum { SLAB_LEAST = 8 << 10, HUGE_PAGE = 2 << 20, SLAB_MOST = 4 << 20 };

struct vs_slab {
  vs_slab *next;
  size_t room, used;
  _Alignas(16) unsigned char data[];
};
struct vs_piece { vs_piece *next; };

static bool slab_add(vs_store *s, size_t least) {
  size_t room = s->slab_bytes / 4;
  if (room < SLAB_LEAST) room = SLAB_LEAST;
  if (room > SLAB_MOST) room = SLAB_MOST;
  if (room > HUGE_PAGE) room -= room % HUGE_PAGE; /* A large slab has a whole number of huge pages, so that the
                                                   * operating system can use such pages for it. */
  room -= sizeof(vs_slab);
  vs_slab *slab = s->alloc(s->context, NULL, 0, sizeof *slab + room);
  /* If memory is nearly out, tries to allocate a smaller slab. */
  if (!slab && room > least) slab = s->alloc(s->context, NULL, 0, sizeof *slab + (room = least));
  if (!slab) return false;
  *slab = (vs_slab){ .next = s->slabs, .room = room };
  s->slabs = slab;
  s->slab_bytes += sizeof *slab + room;
  return true;
}

static void slab_free(vs_store *s, vs_slab *slab) {
  s->slab_bytes -= sizeof *slab + slab->room;
  s->alloc(s->context, slab, sizeof *slab + slab->room, 0);
}

void vs_store_slabs_free(vs_store *s) {
  for (vs_slab *slab = s->slabs, *next; slab; slab = next) {
    next = slab->next;
    slab_free(s, slab);
  }
  s->slabs = NULL;
}

/* Frees all slabs (blocks of small objects) except one, when no object in them is in use. */
static void slabs_empty(vs_store *s) {
  vs_slab *kept = s->slabs;
  memset(s->given_back, 0, sizeof s->given_back);
  s->slabs = kept->next;
  vs_store_slabs_free(s);
  kept->next = NULL;
  kept->used = 0;
  s->slabs = kept;
}

void *vs_store_piece(vs_store *s, size_t bytes) {
  if (PIECES_APART || bytes > VS_PIECE_MOST || !bytes) return vs_store_realloc(s, NULL, 0, bytes);
  if (s->fail_at && !--s->fail_at) s->failing = true;
  if (s->failing) return NULL;
  size_t step = (bytes + 7) / 8;
  void *p = s->given_back[step];
  if (p) {
    s->given_back[step] = s->given_back[step]->next;
  } else {
    if ((!s->slabs || s->slabs->room - s->slabs->used < 8 * step) && !slab_add(s, 8 * step)) return NULL;
    p = s->slabs->data + s->slabs->used;
    s->slabs->used += 8 * step;
  }
  s->bytes += bytes;
  s->piece_count++;
  return p;
}

void vs_store_piece_free(vs_store *s, void *piece, size_t bytes) {
  VS_ASSERT(s->bytes >= bytes);
  if (PIECES_APART || bytes > VS_PIECE_MOST) {
    vs_store_realloc(s, piece, bytes, 0);
    return;
  }
  vs_piece *p = piece;
  size_t step = (bytes + 7) / 8;
  p->next = s->given_back[step];
  s->given_back[step] = p;
  s->bytes -= bytes;
  if (--s->piece_count == 0) slabs_empty(s);
}
