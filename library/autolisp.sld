; AutoLISP: the names in the forms that vm/autolisp/autolisp_reader.c makes of a .lsp file.
(define-library (autolisp)
  (export lisp:variables lisp:nil! lisp:setter lisp:data lisp:defun lisp:finish
          :nil :t :pi :quote :function :lambda :defun :setq :set :if :cond :and :or :while :repeat :foreach :progn
          :eval :apply :mapcar :boundp :vl-catch-all-apply :vl-catch-all-error-p :vl-catch-all-error-message
          :+ :- :* :/ :1+ :1- := :/= :< :> :<= :>= :abs :max :min :rem :gcd :fix :float :sqrt :expt :exp :log :sin :cos :atan
          :eq :equal :not :null :atom :listp :numberp :zerop :minusp :type
          :car :cdr :caar :cadr :cdar :cddr :caaar :caadr :cadar :caddr :cdaar :cdadr :cddar :cdddr :cadddr :cddddr
          :cons :list :append :reverse :length :last :nth :member :assoc :subst :vl-remove :vl-remove-if :vl-remove-if-not :vl-sort
          :strcat :strlen :substr :strcase :itoa :atoi :atof :rtos :angtos :chr :ascii
          :princ :prin1 :print :prompt :alert :terpri
          :polar :angle :distance :inters :xyz :xy :xz :yz :pol :cil :cyl :esf :sph :+xyz :+xy :+xz :+yz :+x :+y :+z :+pol :+cil
          :+cyl :+esf :+sph :cx :cy :cz
          :getpoint :getcorner :getreal :getdist :getint :getangle :getorient :getkword :getstring :initget
          :logand :logior :~ :graphscr :textscr :redraw :vl-load-com :entmake
          :command :vl-cmdf :entlast :entget :entdel :ssget :ssadd :sslength :ssname :getvar :setvar :cut-cone :box2 :erase-all
          :zoom-extents)
  (import (visualscheme))
  (include "autolisp/forms.scm")
  (include "autolisp/values.scm")
  (include "autolisp/points.scm")
  (include "autolisp/entities.scm")
  (include "autolisp/command.scm")
  (include "autolisp/solids.scm")
  (include "autolisp/curves.scm")
  (include "autolisp/edits.scm"))
