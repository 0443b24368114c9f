;;; visualscheme.el --- VisualScheme models in Emacs -*- lexical-binding: t -*-

;; Owns the mode for .vs files: colours and indentation of scheme-mode with the language's own forms, and the commands that call `vs'.

;;; Code:

(require 'scheme)
(require 'compile)
(require 'flymake)

(defgroup visualscheme nil "Solid models from Scheme programs." :group 'languages)

(defcustom visualscheme-program "vs" "The command that runs a model." :type 'string :group 'visualscheme)

(defconst visualscheme-forms '("define-parameter" "define-primitive" "register-drawing-function") "Forms that define something.")
(defconst visualscheme-operations
  '("draw" "unite" "intersect" "subtract" "with-material" "color" "layer" "highlight" "ghost" "only" "hull" "camera" "sun" "sky" "fog" "ground" "units")
  "Words that stand at the head of most expressions of a model.")

(defvar visualscheme-font-lock-keywords
  `((,(concat "(\\(" (regexp-opt visualscheme-forms) "\\)[ \t]+(?\\(\\(?:\\sw\\|\\s_\\)+\\)") (1 font-lock-keyword-face) (2 font-lock-function-name-face))
    (,(concat "[([]" (regexp-opt visualscheme-operations t) "\\_>") 1 font-lock-builtin-face)
    ("[([]\\(\\(?:make\\|do\\)-\\(?:\\sw\\|\\s_\\)+\\)" 1 font-lock-builtin-face)
    ("#:\\(?:\\sw\\|\\s_\\)+" . font-lock-constant-face)))

(defvar visualscheme-mode-map
  (let ((map (make-sparse-keymap)))
    (define-key map (kbd "C-c C-c") #'visualscheme-check)
    (define-key map (kbd "C-c C-k") #'visualscheme-look)
    (define-key map (kbd "C-c C-v") #'visualscheme-view)
    (define-key map (kbd "C-c C-o") #'visualscheme-write)
    map))

;;;###autoload
(define-derived-mode visualscheme-mode scheme-mode "VisualScheme"
  "Mode for VisualScheme models."
  (font-lock-add-keywords nil visualscheme-font-lock-keywords)
  (modify-syntax-entry ?\[ "(]")
  (modify-syntax-entry ?\] ")[")
  (setq-local indent-tabs-mode nil)
  (setq-local indent-line-function #'visualscheme-indent-line)
  (add-hook 'flymake-diagnostic-functions #'visualscheme-flymake nil t))

;; The number of a form's parts before its body.
(dolist (form '((with-material . 1) (layer . 1) (color . 1) (when . 1) (unless . 1) (guard . 1) (parameterize . 1) (let-values . 1) (let*-values . 1)
                (let/cc . 1) (let/ec . 1) (for . 1) (for* . 1) (for/list . 1) (for*/list . 1) (for/vector . 1) (for/sum . 1) (for*/sum . 1)
                (for/and . 1) (for/or . 1) (for/fold . 2) (receive . 2)))
  (put (car form) 'scheme-indent-function (cdr form)))

(defun visualscheme-indent-line (&optional indent)
  "Indent the line as Lisp does; a comment alone stands where code would.
INDENT is what `lisp-indent-line' takes."
  (if (save-excursion (back-to-indentation) (looking-at ";"))
      (let ((column (calculate-lisp-indent)))
        (when column (indent-line-to (if (consp column) (car column) column))))
    (lisp-indent-line indent)))

(defun visualscheme--run (&rest words)
  "Run `visualscheme-program' with WORDS.
What it says can be visited by `next-error'."
  (save-buffer)
  (compile (mapconcat #'shell-quote-argument (cons visualscheme-program words) " ")))

(defun visualscheme-check ()
  "Evaluate the file and write nothing."
  (interactive)
  (visualscheme--run "--check" (file-name-nondirectory buffer-file-name)))

(defun visualscheme-look ()
  "List what looks wrong in the file, without running it."
  (interactive)
  (visualscheme--run "check" (file-name-nondirectory buffer-file-name)))

(defun visualscheme--findings (output buffer)
  "Make flymake's diagnostics of what `vs check' said of BUFFER's file in OUTPUT."
  (let (found)
    (with-current-buffer output
      (goto-char (point-min))
      (while (re-search-forward "^\\([^ \n:]+\\):\\([0-9]+\\):\\([0-9]+\\): \\([a-z-]+: .*\\)$" nil t)
        (let ((file (match-string 1)) (line (string-to-number (match-string 2))) (column (string-to-number (match-string 3))) (text (match-string 4)))
          (when (equal (file-name-nondirectory file) (file-name-nondirectory (buffer-file-name buffer)))
            (let ((region (flymake-diag-region buffer line column)))
              (push (flymake-make-diagnostic buffer (car region) (cdr region) :warning text) found))))))
    (nreverse found)))

(defun visualscheme-flymake (report &rest _)
  "Give REPORT what `vs check' says of the file, once it is saved."
  (when (and buffer-file-name (not (buffer-modified-p)))
    (let ((buffer (current-buffer)) (output (generate-new-buffer " *vs check*")))
      (make-process
       :name "vs-check" :buffer output :noquery t :connection-type 'pipe
       :command (list visualscheme-program "check" (file-name-nondirectory buffer-file-name))
       :sentinel (lambda (process _)
                   (unless (process-live-p process)
                     ;; A language server that has started meanwhile replaces this function, and flymake
                     ;; refuses reports of functions that it does not know.
                     (when (and (buffer-live-p buffer)
                                (memq #'visualscheme-flymake
                                      (buffer-local-value 'flymake-diagnostic-functions buffer)))
                       (funcall report (visualscheme--findings output buffer)))
                     (kill-buffer output)))))))

(defun visualscheme-write (output)
  "Write the model to OUTPUT, by its ending."
  (interactive "FWrite to: ")
  (visualscheme--run (file-name-nondirectory buffer-file-name) "-o" (expand-file-name output)))

(defun visualscheme-view ()
  "Show the model in the browser, as it is edited."
  (interactive)
  (save-buffer)
  (let ((process (start-process "vs-view" (get-buffer-create "*vs view*") visualscheme-program "view" "-q" buffer-file-name)))
    (set-process-query-on-exit-flag process nil)
    (set-process-filter process (lambda (_ text)
                                  (when (string-match "http://127[^ \n]+" text) (browse-url (match-string 0 text)))))))

;; The language server for eglot.
(defvar eglot-server-programs)
(defun visualscheme-server (&optional _)
  "The command of the language server."
  (list visualscheme-program "lsp"))
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(visualscheme-mode . visualscheme-server)))

;; FILE:LINE:COLUMN: message
(add-to-list 'compilation-error-regexp-alist-alist '(visualscheme "^\\([^ \n:]+\\.vs\\):\\([0-9]+\\):\\([0-9]+\\): \\(?:\\(warning\\)\\|\\(note\\)\\|\\)" 1 2 3 (4 . 5)))
(add-to-list 'compilation-error-regexp-alist 'visualscheme)

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.vs\\'" . visualscheme-mode))

(provide 'visualscheme)
;;; visualscheme.el ends here
