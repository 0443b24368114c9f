/* Declares the definitions at the start of each AutoLISP program: a function for each kind of solid. */
#ifndef VS_BACKENDS_AUTOLISP_AUTOLISP_HEAD_H
#define VS_BACKENDS_AUTOLISP_AUTOLISP_HEAD_H

extern const char vs_autolisp_head[], vs_autolisp_foot[];

#endif
